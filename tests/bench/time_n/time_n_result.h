// What the time-N bench measured, and its outside: JSON and CSV.
#pragma once

#include "bench/time_n/time_n_scene.h"
#include "resolution/dynamic_resolution.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxsheet::bench {

struct TimeNOptions {
    TimeNScene scene;
    int maxN = 64;
    int dim = 256;                                               ///< samples per axis of each dataset
    std::uint64_t textureBudgetBytes = std::uint64_t{256} << 20; ///< of the paper's graphics card
    std::uint64_t memoryBudgetBytes = std::uint64_t{512} << 20;  ///< of the paper's machine, about
    ResolutionRule rule;
    int frames = 2;      ///< per N, visit and round; the median of all counts
    int visits = 3;      ///< of each N, at different times
    int step = 1;        ///< nextN(): every step-th, denser at small N, and maxN
    double stopMs = 0.0; ///< ends at the first N whose frame takes longer; 0: at maxN
    int device = -1;
};

/// T_N: the frame of N datasets at one level, from state to host pixels.
struct TimeNPoint {
    int n = 0;
    int level = 0;
    /// Reading and uploading included; but for reading, at the pace that the machine had at first.
    MeasuredMedian ms;
    double wallMs = 0.0;   ///< the median by the clock
    double slowdown = 1.0; ///< of the machine meanwhile, against its pace at first (MachinePace)
    double uploadMs = 0.0; ///< medians of the frames' sums over tiles
    double ioMs = 0.0;
    // As dynamic resolution saw them, at the first visit; when it is off, of all visits:
    std::optional<double> rawRatio;  ///< the paper's R of T_{N-2}, T_{N-1} and T_N
    std::optional<SlopeRatio> ratio; ///< the fitted one
    std::uint64_t residentBytes = 0; ///< of textures, the largest of all frames
    std::uint64_t hostBytes = 0;     ///< of host memory, likewise
    std::uint64_t diskBytesPerFrame = 0;
    bool movesTextures = false; ///< resting frames bring in again what had to go
    bool readsDisk = false;     ///< and read from the disk again
};

/// A run of N at one level, and how straight it is.
struct TimeNSegment {
    int level = 0;
    int firstN = 0;
    int lastN = 0;
    StraightLine line;
    std::optional<double> maxResidual; ///< the largest |T_N - line| / line; with three points or more
    std::optional<double> slopeRatio; ///< slope of the last quarter / of the first; with eight points or more
};

/// Where the time-N curve bends.
struct TimeNTransition {
    SlopeBend bend;
    int level = 0;
    std::string cause;           ///< "texture budget", "memory budget", "unknown"
    std::optional<int> newLevel; ///< that dynamic resolution answered with
};

struct TimeNResult {
    TimeNOptions options;
    std::string renderer;
    std::vector<TimeNPoint> points; ///< by N, each at the level that the rule gives a sheet of N datasets
    std::vector<TimeNPoint> trials; ///< measured at a finer level before the rule was found broken there
    /// Of segments that were measured again, to see whether they bend for good.
    std::vector<TimeNPoint> earlierPasses;
    std::vector<TimeNSegment> segments;
    std::vector<TimeNTransition> transitions;
    std::optional<int> textureSwapN; ///< TimeNPoint::movesTextures, of the first N
    std::optional<int> memorySwapN;  ///< TimeNPoint::readsDisk, likewise
    int nMax = 0; ///< the last N before the first bend that breaks the rule and was not answered by a coarser
                  ///< level; the last N measured when there is none
    double timerGpuMs = 0.0;
    double timerHostMs = 0.0;
    bool timersAgree = true;
    bool onDisk = true;
    std::optional<double> otherLoad; ///< share of the processors' time that other processes took meanwhile
};

/// Segments of consecutive points of one level.
[[nodiscard]] std::vector<TimeNSegment> segmentsOf(const std::vector<TimeNPoint>& points);

/// A sentence for people when other processes took more than a tenth of the processors' time; else empty.
[[nodiscard]] std::string busyMachine(const TimeNResult& result);

/// Sentences for people about regimes that did not appear, and why.
[[nodiscard]] std::vector<std::string> absentRegimes(const TimeNResult& result);

[[nodiscard]] std::string jsonOf(const TimeNResult& result);
/// One row per point of each result, trials too; with a header.
[[nodiscard]] std::string csvOf(std::span<const TimeNResult> results);

} // namespace voxsheet::bench
