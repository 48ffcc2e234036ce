#include "engine/formula_job.h"

#include "base/errors.h"
#include "base/huge_page_block.h"
#include "base/thread_count.h"
#include "engine/sample_reader.h"
#include "store/store_key.h"
#include "volume/parallel_for.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>

namespace voxsheet::engine {

namespace {

/// Of what is stored: 2 keeps the inputs' quantity.
const std::string kVersion = "2 ";
constexpr long kSlabSamples = 1L << 16; ///< per input: 512 KiB of doubles, which stay in a core's cache

int slabSlices(const glm::ivec3& dims) {
    const long slice = static_cast<long>(dims.x) * dims.y;
    return static_cast<int>(std::clamp(kSlabSamples / slice, 1L, static_cast<long>(dims.z)));
}

DatasetMeta resultMeta(const FormulaTask& task, const std::string& key) {
    const DatasetMeta& first = *task.inputs.front().meta;
    DatasetMeta meta;
    meta.key = key;
    meta.sourcePath = task.formula;
    meta.format = "formula";
    meta.grid = first.grid;
    meta.sourceType = ScalarType::F32;
    meta.lengthUnit = first.lengthUnit;
    meta.anatomical = first.anatomical;
    meta.crystal = first.crystal;
    meta.times = {first.times.at(static_cast<std::size_t>(task.inputs.front().step))};
    std::vector<ValueMeaning> meanings;
    for (const FormulaInput& input : task.inputs) {
        const FieldMeta& field = input.meta->fields.at(static_cast<std::size_t>(input.field));
        meanings.push_back({field.quantity, field.unit});
    }
    const ValueMeaning meaning = formulaMeaning(task.plan, meanings);
    FieldMeta field;
    field.name = "result";
    field.quantity = meaning.quantity;
    field.unit = meaning.unit;
    field.storedType = ScalarType::F32;
    field.steps.resize(1);
    meta.fields.push_back(std::move(field));
    return meta;
}

/// One thread's part of a formula: reads a slab of every input and computes it.
void computeSlab(const FormulaTask& task, const VolumeProvider& volumes, int z, int count,
                 std::span<float> out) {
    std::vector<std::vector<double>> values;
    std::vector<sheet::PlanArray> arrays;
    for (const FormulaInput& input : task.inputs) {
        const VolumeKey key{input.meta->key, input.field, input.step, 0};
        values.push_back(readValues(volumes, *input.meta, key, z, count));
    }
    for (const auto& each : values)
        arrays.emplace_back(std::span<const double>(each));
    sheet::evaluatePlan(task.plan, arrays, out);
}

/// Floats, x fastest.
HugePageBlock computeSamples(const FormulaTask& task, const VolumeProvider& volumes,
                             const JobControl& control) {
    const glm::ivec3 dims = task.inputs.front().meta->grid.dims;
    const auto slice = static_cast<std::size_t>(dims.x) * static_cast<std::size_t>(dims.y);
    HugePageBlock result(slice * static_cast<std::size_t>(dims.z) * sizeof(float));
    const std::span<float> samples(reinterpret_cast<float*>(result.data()), result.size() / sizeof(float));
    std::mutex mutex; // of the progress, which never goes back
    int slicesDone = 0;
    parallelFor(dims.z, slabSlices(dims), [&](long begin, long end) {
        if (control.cancelled && control.cancelled())
            throw Cancelled("formula " + task.formula, "it is not needed any more");
        const auto count = static_cast<int>(end - begin);
        computeSlab(task, volumes, static_cast<int>(begin), count,
                    samples.subspan(slice * static_cast<std::size_t>(begin),
                                    slice * static_cast<std::size_t>(count)));
        const std::lock_guard lock(mutex);
        slicesDone += count;
        if (control.progress) control.progress(0.8 * slicesDone / dims.z);
    });
    return result;
}

/// A quantity's or unit's word where the plan keeps it, else "".
std::string keptWord(const sheet::FormulaPlan& plan, const std::vector<std::string>& inputs) {
    std::vector<std::optional<std::string>> words; // of each step, where it has one
    std::vector<bool> pure;
    for (const sheet::PlanStep& step : plan.steps) {
        std::optional<std::string> word;
        bool isPure = false;
        const auto a = static_cast<std::size_t>(std::max(step.a, 0));
        const auto b = static_cast<std::size_t>(std::max(step.b, 0));
        switch (step.op) {
        case sheet::FormulaOp::Input:
            if (!inputs.at(a).empty()) word = inputs[a];
            break;
        case sheet::FormulaOp::Constant:
            isPure = true;
            break;
        case sheet::FormulaOp::Negate:
        case sheet::FormulaOp::Abs:
            word = words[a];
            isPure = pure[a];
            break;
        case sheet::FormulaOp::Add:
        case sheet::FormulaOp::Subtract:
            // "density + 1" is read as a number of the same unit.
            isPure = pure[a] && pure[b];
            if (pure[b] || words[a] == words[b])
                word = words[a];
            else if (pure[a])
                word = words[b];
            break;
        case sheet::FormulaOp::Multiply:
            isPure = pure[a] && pure[b];
            if (pure[a] != pure[b]) word = pure[a] ? words[b] : words[a];
            break;
        case sheet::FormulaOp::Divide:
            isPure = pure[a] && pure[b];
            if (pure[b]) word = words[a];
            break;
        }
        words.push_back(std::move(word));
        pure.push_back(isPure);
    }
    return words.empty() ? std::string{} : words.back().value_or("");
}

} // namespace

std::string formulaEntryKey(const FormulaTask& task) {
    std::vector<std::string> keys;
    for (const FormulaInput& input : task.inputs) {
        keys.push_back(input.meta->key + "/" + std::to_string(input.field) + "/" +
                       std::to_string(input.step));
    }
    return store::formulaKey(kVersion + sheet::planCacheKey(task.plan, keys), keys);
}

ValueMeaning formulaMeaning(const sheet::FormulaPlan& plan, const std::vector<ValueMeaning>& inputs) {
    std::vector<std::string> quantities;
    std::vector<std::string> units;
    for (const ValueMeaning& input : inputs) {
        quantities.push_back(input.quantity);
        units.push_back(input.unit);
    }
    return {keptWord(plan, quantities), keptWord(plan, units)};
}

std::uint64_t formulaMemoryBytes(const FormulaTask& task) {
    const glm::ivec3 dims = task.inputs.front().meta->grid.dims;
    const auto samples = static_cast<std::uint64_t>(sampleCount(dims));
    const auto slab = static_cast<std::uint64_t>(slabSlices(dims)) * static_cast<std::uint64_t>(dims.x) *
                      static_cast<std::uint64_t>(dims.y);
    const auto slabs = static_cast<std::uint64_t>((dims.z + slabSlices(dims) - 1) / slabSlices(dims));
    const auto threads = std::min(slabs, static_cast<std::uint64_t>(threadCount().threads));
    // The result, its pyramid (1/8 + 1/64 + ... of it, with working copies), and each thread's slab of every
    // input.
    return samples * sizeof(float) * 3 / 2 +
           threads * slab * (sizeof(double) * (task.inputs.size() + 1) + sizeof(float));
}

ComputedEntry computeFormula(const FormulaTask& task, const store::VolumeStore& store,
                             const VolumeProvider& volumes, std::uint64_t memoryBudgetBytes,
                             const JobControl& control) {
    const std::string key = formulaEntryKey(task);
    if (const auto entry = store.open(key)) return ComputedEntry(entry);
    requireMemory("formula " + task.formula, formulaMemoryBytes(task), memoryBudgetBytes);
    const auto samples = computeSamples(task, volumes, control);
    return {store, resultMeta(task, key), {samples.data(), samples.size()}};
}

} // namespace voxsheet::engine
