#include "import/formats/xml_walk.h"

#include "base/errors.h"

#include <expat.h>

namespace voxsheet::import {

namespace {

constexpr const char* kAdvice = "the file is damaged or incomplete: copy or write it again";

} // namespace

/// Exceptions must not pass through expat's C code.
template <typename Body>
void XmlWalk::guarded(void* self, const Body& body) {
    auto& walk = *static_cast<XmlWalk*>(self);
    if (walk.failure_ || walk.stopped_) return;
    try {
        body(walk);
    } catch (...) {
        walk.failure_ = std::current_exception();
        XML_StopParser(walk.parser_.get(), XML_FALSE);
    }
}

XmlWalk::XmlWalk(std::string name, Events events)
    : name_(std::move(name)), events_(std::move(events)),
      parser_(XML_ParserCreate(nullptr), [](XML_ParserStruct* parser) { XML_ParserFree(parser); }) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const XML_Char* element, const XML_Char** attributes) {
            guarded(self, [&](XmlWalk& walk) {
                if (!walk.events_.start) return;
                Attributes map;
                for (; attributes[0]; attributes += 2)
                    map[attributes[0]] = attributes[1];
                walk.events_.start(element, map);
            });
        },
        [](void* self, const XML_Char* element) {
            guarded(self, [&](XmlWalk& walk) {
                if (walk.events_.end) walk.events_.end(element);
            });
        });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* text, int length) {
        guarded(self, [&](XmlWalk& walk) {
            if (walk.events_.text) walk.events_.text({text, static_cast<std::size_t>(length)});
        });
    });
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
            guarded(self, [](XmlWalk& walk) {
                throw InvalidInput(walk.name_, "it declares a document type, which no file of its kind does",
                                   kAdvice);
            });
        });
}

void XmlWalk::feed(std::string_view piece, bool last) {
    if (stopped_) return;
    const auto status = XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), last);
    if (failure_) std::rethrow_exception(failure_);
    if (status == XML_STATUS_OK || stopped_) return;
    throw InvalidInput(name_,
                       "line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ": " +
                           XML_ErrorString(XML_GetErrorCode(parser_.get())),
                       kAdvice);
}

void XmlWalk::stop() {
    stopped_ = true;
    XML_StopParser(parser_.get(), XML_FALSE);
}

std::uint64_t XmlWalk::bytePosition() const {
    return static_cast<std::uint64_t>(XML_GetCurrentByteIndex(parser_.get()));
}

std::string valueOf(const XmlWalk::Attributes& attributes, const std::string& name,
                    const std::string& fallback) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? fallback : found->second;
}

} // namespace voxsheet::import
