// Walking over XML whose author nobody vouches for, by expat.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

struct XML_ParserStruct;

namespace voxsheet::import {

class XmlWalk {
public:
    using Attributes = std::map<std::string, std::string>;
    /// Each may be empty, and may throw.
    struct Events {
        std::function<void(const std::string& element, const Attributes&)> start;
        std::function<void(const std::string& element)> end;
        std::function<void(std::string_view characters)> text; ///< in pieces
    };

    /// \param name  of the file, for errors
    XmlWalk(std::string name, Events events);

    /// The next piece; `last`: nothing follows. Throws what an event threw, InvalidInput (subject: the name)
    /// for what is no XML, and for a document type, whose entities can grow without end. After stop(), pieces
    /// are not looked at.
    void feed(std::string_view piece, bool last);

    /// For events: what follows is of no interest, and need not be XML.
    void stop();
    [[nodiscard]] bool stopped() const { return stopped_; }
    /// For events: of the first byte of this one.
    [[nodiscard]] std::uint64_t bytePosition() const;

private:
    template <typename Body>
    static void guarded(void* self, const Body& body);

    std::string name_;
    Events events_;
    std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
    std::exception_ptr failure_;
    bool stopped_ = false;
};

[[nodiscard]] std::string valueOf(const XmlWalk::Attributes& attributes, const std::string& name,
                                  const std::string& fallback = {});

} // namespace voxsheet::import
