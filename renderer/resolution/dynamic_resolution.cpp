#include "resolution/dynamic_resolution.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace voxsheet {

namespace {

struct NamedCriterion {
    ResolutionCriterion criterion;
    const char* name;
};

constexpr NamedCriterion kCriteria[] = {{ResolutionCriterion::Off, "off"},
                                        {ResolutionCriterion::Slope, "slope"},
                                        {ResolutionCriterion::SlopeFirst, "slope-first"},
                                        {ResolutionCriterion::Time, "time"},
                                        {ResolutionCriterion::Rate, "rate"},
                                        {ResolutionCriterion::Count, "count"},
                                        {ResolutionCriterion::Bytes, "bytes"}};

/// A level has an eighth of the samples of the next finer one.
constexpr double kSamplesRatio = 8.0;

void validate(const ResolutionRule& rule) {
    const auto positive = [](double value, const char* what) {
        if (!std::isfinite(value) || value <= 0.0)
            throw InvalidInput("dynamic resolution", std::string(what) + " must be above 0");
    };
    positive(rule.frameMs, "the longest time of a frame");
    positive(rule.framesPerSecond, "the fewest frames per second");
    positive(rule.datasets, "the number of datasets");
    positive(static_cast<double>(rule.bytes), "the number of bytes");
    positive(rule.upFraction, "the share for going back");
    if (rule.upFraction > 1.0)
        throw InvalidInput("dynamic resolution", "the share for going back must be at most 1");
}

void validateLevels(int levels) {
    if (levels < 1) throw InvalidInput("dynamic resolution", "there must be one level at least");
}

std::string number(double value, int decimals = 2) {
    if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string inWords(const SlopeRatio& ratio) {
    return "R = " + number(ratio.value) + " (" + number(ratio.low) + " to " + number(ratio.high) + ")";
}

std::string verdictInWords(const std::optional<SlopeRatio>& ratio) {
    if (!ratio) return "the time-N curve has too few points yet to judge its slope";
    if (!ratio->comparable)
        return "times fell while N grew, as when a busy machine becomes idle: there is no slope to compare "
               "with";
    return "the time-N curve keeps the rule: " + inWords(*ratio);
}

std::string inWords(const TimePoint& point) {
    return number(point.ms.value, 1) + " ms (" + number(point.ms.low, 1) + " to " + number(point.ms.high, 1) +
           ")";
}

} // namespace

const char* resolutionCriterionName(ResolutionCriterion criterion) {
    for (const auto& known : kCriteria)
        if (known.criterion == criterion) return known.name;
    return "";
}

std::optional<ResolutionCriterion> resolutionCriterionFromName(std::string_view name) {
    for (const auto& known : kCriteria)
        if (known.name == name) return known.criterion;
    return std::nullopt;
}

DynamicResolution::DynamicResolution(const ResolutionRule& rule, int levels) : rule_(rule), levels_(levels) {
    validate(rule);
    validateLevels(levels);
    lastN_.resize(static_cast<std::size_t>(levels));
    watches_.resize(static_cast<std::size_t>(levels));
}

void DynamicResolution::addFrame(int n, double ms) { times_.add(n, level_, ms); }

void DynamicResolution::addPartialFrame(int n, double ms, double doubtMs) {
    times_.addPartly(n, level_, ms, doubtMs);
}

void DynamicResolution::forgetTimes() {
    times_ = {};
    std::fill(watches_.begin(), watches_.end(), SlopeWatch{});
}

void DynamicResolution::restart() {
    forgetTimes();
    std::fill(lastN_.begin(), lastN_.end(), std::nullopt);
    level_ = 0;
}

void DynamicResolution::setRule(const ResolutionRule& rule) {
    validate(rule);
    rule_ = rule;
}

void DynamicResolution::setLevels(int levels) {
    validateLevels(levels);
    levels_ = levels;
    lastN_.resize(static_cast<std::size_t>(levels));
    watches_.resize(static_cast<std::size_t>(levels));
    level_ = std::min(level_, levels - 1);
}

Decision DynamicResolution::decide(const SheetLoad& load) {
    if (load.n < 1) return stay("nothing is shown");
    switch (rule_.criterion) {
    case ResolutionCriterion::Off:
        break;
    case ResolutionCriterion::Slope:
        return decideBySlope(load.n, kPaperRatioLimit);
    case ResolutionCriterion::SlopeFirst:
        return decideBySlope(load.n, kFirstTransitionRatioLimit);
    case ResolutionCriterion::Time:
        return decideByTime(load.n, rule_.frameMs);
    case ResolutionCriterion::Rate:
        return decideByTime(load.n, 1000.0 / rule_.framesPerSecond);
    case ResolutionCriterion::Count:
        return decideByAmount(load.n, rule_.datasets, "datasets");
    case ResolutionCriterion::Bytes:
        return decideByAmount(static_cast<double>(load.levelZeroBytes), static_cast<double>(rule_.bytes),
                              "bytes");
    }
    return stay("dynamic resolution is off");
}

Decision DynamicResolution::stay(std::string reason) const {
    return {level_, false, std::move(reason), {}, {}};
}

Decision DynamicResolution::moveTo(int level, std::string reason) {
    const bool changed = level != level_;
    level_ = level;
    return {level_, changed, "level " + std::to_string(level) + ": " + std::move(reason), {}, {}};
}

Decision DynamicResolution::decideBySlope(int n, double ratioLimit) {
    if (level_ > 0) {
        const auto lastN = lastN_[static_cast<std::size_t>(level_ - 1)];
        // Another rule chose this level: the finer one is tried, and measured.
        if (!lastN) return moveTo(level_ - 1, "the finer level is not known to break the rule");
        if (n <= rule_.upFraction * *lastN)
            return moveTo(level_ - 1, "with " + std::to_string(n) +
                                          " datasets the finer level is well below N = " +
                                          std::to_string(*lastN) + ", up to which it kept the rule");
    }
    const auto here = static_cast<std::size_t>(level_);
    const auto curve = times_.curve(level_, n);
    const auto bend = watches_[here].judge(curve, ratioLimit);
    Decision decision;
    if (bend && bend->breaksRule) {
        const std::string why = "after N = " + std::to_string(bend->lastN) +
                                " the slope of the time-N curve grew by " + inWords(bend->ratio) +
                                ", above " + number(ratioLimit, 1);
        lastN_[here] = bend->lastN;
        decision =
            level_ + 1 < levels_ ? moveTo(level_ + 1, why) : stay(why + ", and there is no coarser level");
        decision.ratio = bend->ratio;
    } else {
        const auto ratio = bend ? std::optional(bend->ratio)
                                : newestSlopeRatio(segmentFrom(curve, watches_[here].segmentFirstN()));
        decision = stay(verdictInWords(ratio));
        decision.ratio = ratio;
    }
    decision.rawRatio = rawSlopeRatio(curve);
    return decision;
}

double DynamicResolution::expectedFinerMs(int n, double currentMs) const {
    if (const auto known = times_.point(n, level_ - 1)) return known->ms.value;
    const auto finer = times_.curve(level_ - 1, std::numeric_limits<int>::max());
    if (finer.size() >= 2) return std::max(currentMs, fitStraightLine(finer).at(n));
    return kSamplesRatio * currentMs;
}

Decision DynamicResolution::decideByTime(int n, double limitMs) {
    const auto point = times_.point(n, level_);
    if (!point) return stay("no frame of " + std::to_string(n) + " datasets was measured yet at this level");
    const auto curve = times_.curve(level_, n);
    const std::string limit = number(limitMs, 1) + " ms";
    Decision decision;
    if (point->ms.low > limitMs) {
        const auto why = "a frame takes " + inWords(*point) + ", above " + limit;
        decision =
            level_ + 1 < levels_ ? moveTo(level_ + 1, why) : stay(why + ", and there is no coarser level");
    } else if (const double finer = level_ > 0 ? expectedFinerMs(n, point->ms.value) : 0.0;
               level_ > 0 && finer < rule_.upFraction * limitMs) {
        decision = moveTo(level_ - 1, "a frame takes " + inWords(*point) + ", and about " + number(finer, 1) +
                                          " ms at the finer level, well below " + limit);
    } else {
        decision = stay("a frame takes " + inWords(*point) + "; the limit is " + limit);
    }
    decision.rawRatio = rawSlopeRatio(curve);
    decision.ratio = newestSlopeRatio(curve);
    return decision;
}

Decision DynamicResolution::decideByAmount(double amount, double limitAtLevelZero, const char* what) {
    const auto limitAt = [&](int level) { return limitAtLevelZero * std::pow(kSamplesRatio, level); };
    int level = level_;
    while (level + 1 < levels_ && amount > limitAt(level))
        ++level;
    while (level > 0 && amount <= rule_.upFraction * limitAt(level - 1))
        --level;
    const std::string why =
        number(amount, 0) + " " + what + "; this level takes up to " + number(limitAt(level), 0) + " " + what;
    return level == level_ ? stay(why) : moveTo(level, why);
}

} // namespace voxsheet
