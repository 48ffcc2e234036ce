#include "gpu/workarounds.h"

#include "base/errors.h"
#include "gpu/egl_context.h"

#include <algorithm>
#include <array>

namespace voxsheet::gpu {

namespace {

struct Named {
    const char* name;
    bool Workarounds::*member;
};

constexpr std::array kKnown{
    Named{"clear-before-compute", &Workarounds::clearBeforeCompute},
    Named{"r8-as-r16", &Workarounds::r8AsR16},
    Named{"coarse-filter-weights", &Workarounds::coarseFilterWeights},
    Named{"simd-rays", &Workarounds::simdRays},
};

void switchOff(Workarounds& workarounds, std::string_view name) {
    std::string known;
    for (const Named& candidate : kKnown) {
        if (name == candidate.name) {
            workarounds.*candidate.member = false;
            return;
        }
        known += (known.empty() ? "" : ", ") + std::string(candidate.name);
    }
    throw InvalidInput("VOXSHEET_DISABLE_WORKAROUNDS",
                       "there is no workaround named '" + std::string(name) + "'",
                       "use a comma-separated list of: " + known)
        .withField("VOXSHEET_DISABLE_WORKAROUNDS");
}

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

} // namespace

Workarounds workaroundsFor(std::string_view renderer, std::string_view disabled) {
    Workarounds workarounds;
    if (renderer.find("llvmpipe") != std::string_view::npos) {
        workarounds.clearBeforeCompute = true;
        workarounds.r8AsR16 = true;
        workarounds.simdRays = VOXSHEET_SIMD != 0;
    }
    workarounds.coarseFilterWeights = !isSoftwareRenderer(std::string(renderer));
    while (!disabled.empty()) {
        const std::size_t comma = disabled.find(',');
        const std::string_view name = trimmed(disabled.substr(0, comma));
        if (!name.empty()) switchOff(workarounds, name);
        disabled = comma == std::string_view::npos ? std::string_view{} : disabled.substr(comma + 1);
    }
    return workarounds;
}

std::vector<std::string> workaroundNames(const Workarounds& workarounds) {
    std::vector<std::string> names;
    for (const Named& candidate : kKnown) {
        if (workarounds.*candidate.member) names.emplace_back(candidate.name);
    }
    return names;
}

Workarounds workaroundsNamed(const std::vector<std::string>& names) {
    Workarounds workarounds;
    for (const Named& candidate : kKnown)
        workarounds.*candidate.member = std::find(names.begin(), names.end(), candidate.name) != names.end();
    return workarounds;
}

} // namespace voxsheet::gpu
