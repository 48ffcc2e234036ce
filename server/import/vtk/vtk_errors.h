// VTK reports errors to a global window and goes on; here they are collected, so that a read that complained
// fails.
#pragma once

#include <string>

namespace voxsheet::import {

/// While it lives, VTK's messages go here. One at a time in a process.
class VtkErrorCollector {
public:
    VtkErrorCollector();
    ~VtkErrorCollector();
    VtkErrorCollector(const VtkErrorCollector&) = delete;
    VtkErrorCollector& operator=(const VtkErrorCollector&) = delete;

    /// The first error in one line without VTK's file names and addresses; empty when there was none.
    [[nodiscard]] std::string firstError() const;
};

} // namespace voxsheet::import
