// Files are known by their content: under any name they are the same volume.
#include "sample_files.h"
#include "vtk_fixture.h"

namespace voxsheet::import::testing {
namespace {

class FormatRecognition : public FormatsTest {
protected:
    static void expectSame(const Loaded& one, const Loaded& other, const std::string& what) {
        EXPECT_EQ(one.meta().format, other.meta().format) << what;
        EXPECT_EQ(one.meta().grid, other.meta().grid) << what;
        EXPECT_EQ(one.arrays, other.arrays) << what;
    }
    fs::path placed(const SampleFile& sample) const {
        for (const auto& [name, bytes] : sample.beside)
            write(name, bytes);
        return write(sample.name, sample.bytes);
    }
};

TEST_F(FormatRecognition, AnyNameWillDo) {
    int checked = 0;
    for (const auto& sample : allSamples(folder_)) {
        // OBJ and raw sidecars have no mark of their own, pairs of NIfTI find each other by name.
        const auto& name = sample.name;
        if (name.ends_with(".obj") || name.ends_with(".json") || name == "pair.hdr") continue;
        const auto own = loadAny(placed(sample));
        for (const auto* other : {"volume", "volume.dat", "volume.tif", "volume.txt", "volume.nrrd"})
            expectSame(own, loadAny(write(other, sample.bytes)), name + " as " + other);
        ++checked;
    }
    EXPECT_GT(checked, 25);
}

TEST_F(FormatRecognition, CrystalsMayBeCompressed) {
    int checked = 0;
    for (const auto& sample : volumeSamples()) {
        const auto& name = sample.name;
        if (name != "CHGCAR" && name != "salt.xsf" && name != "salt.cube") continue;
        const auto own = loadAny(placed(sample));
        expectSame(own, loadAny(write(name + ".gz", gzipped(sample.bytes))), name + ".gz");
        expectSame(own, loadAny(write(name + ".bz2", bzipped(sample.bytes))), name + ".bz2");
        ++checked;
    }
    EXPECT_EQ(checked, 3);
}

} // namespace
} // namespace voxsheet::import::testing
