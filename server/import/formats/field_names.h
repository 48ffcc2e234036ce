// Names of the fields that a file's components become.
#pragma once

#include "volume/dataset.h"

#include <string>
#include <vector>

namespace voxsheet::import {

/// `count` fields of one type with unique names: "value" for a single one, else the given names, else "value
/// 1", ….
[[nodiscard]] std::vector<FieldMeta> makeFields(int count, ScalarType type,
                                                const std::vector<std::string>& names = {});

/// Throws LimitExceeded (subject `what`) above the number of fields or steps that a dataset may have.
void checkFieldsAndSteps(const std::string& what, std::int64_t fields, std::int64_t steps);

/// The same names, the second and later equal ones with " (2)", " (3)", …; empty ones are "value".
[[nodiscard]] std::vector<std::string> uniqueNames(std::vector<std::string> names);

} // namespace voxsheet::import
