#include "sheet/bounded_json.h"

#include "base/errors.h"
#include "sheet/utf8.h"

#include <set>
#include <vector>

#include <nlohmann/json.hpp>

namespace voxsheet::sheet {

using nlohmann::json;

namespace {

/// Watches the parser: depth, and the members of every object that is open.
class Guard {
public:
    Guard(const std::string& what, int maxDepth) : what_(what), maxDepth_(maxDepth) {}

    bool operator()(int, json::parse_event_t event, json& parsed) {
        using Event = json::parse_event_t;
        if (event == Event::object_start || event == Event::array_start) {
            members_.emplace_back();
            if (static_cast<int>(members_.size()) > maxDepth_)
                throw InvalidInput(what_, "nests deeper than " + std::to_string(maxDepth_) + " levels",
                                   "this is no document of Voxsheet");
        } else if (event == Event::object_end || event == Event::array_end) {
            members_.pop_back();
        } else if (event == Event::key) {
            const auto& name = parsed.get_ref<const std::string&>();
            if (!members_.back().insert(name).second)
                throw InvalidInput(what_, "has the member " + inQuotes(name) + " twice in one object",
                                   "keep one of them")
                    .withField(name);
        }
        return true;
    }

private:
    const std::string& what_;
    int maxDepth_;
    std::vector<std::set<std::string>> members_;
};

} // namespace

json parseBoundedJson(std::string_view text, const std::string& what, JsonLimits limits) {
    if (text.size() > limits.bytes)
        throw LimitExceeded(what, "is longer than " + std::to_string(limits.bytes) + " bytes", "send less");
    try {
        return json::parse(text, Guard(what, limits.depth));
    } catch (const json::parse_error& error) {
        throw InvalidInput(what, "is not JSON: unexpected text at byte " + std::to_string(error.byte),
                           "check the brackets, quotes and commas there");
    } catch (const json::out_of_range&) {
        throw InvalidInput(what, "holds a number that is out of range", "use numbers within 1e308");
    }
}

} // namespace voxsheet::sheet
