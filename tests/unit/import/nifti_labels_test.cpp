// Tables of labels in the extensions of NIfTI headers.
#include "formats_fixture.h"
#include "nifti_bytes.h"

namespace voxsheet::import::testing {
namespace {

std::string table(const std::string& labels) {
    return R"(<?xml version="1.0" encoding="UTF-8"?> <CaretExtension>  <Date><![CDATA[2013-07-14T05:45:09]]></Date>)"
           R"(   <VolumeInformation Index="0">   <LabelTable>)" +
           labels +
           R"(</LabelTable>  <StudyMetaDataLinkSet>  </StudyMetaDataLinkSet>  )"
           R"(<VolumeType><![CDATA[Label]]></VolumeType>   </VolumeInformation></CaretExtension>)";
}

const std::string kLabels =
    R"(<Label Key="1" Red="1" Green="0.25" Blue="0" Alpha="1"><![CDATA[spleen]]></Label>)"
    R"(<Label Key="7" Red="0" Green="2" Blue="0" Alpha="1">disc &amp; L1</Label>)";

class NiftiLabels : public FormatsTest {
protected:
    /// A volume of 2 x 1 x 1 whose header has the extensions, each a code and its content.
    static std::string file(int version, bool big, const std::vector<std::pair<int, std::string>>& extensions,
                            bool single = true) {
        NiftiBytes header(version, big, {2, 1, 1}, 2, single);
        header.setSform({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
        std::string blocks(extensions.empty() ? "\0\0\0\0" : "\1\0\0\0", 4);
        for (const auto& [code, content] : extensions) {
            const auto size = (content.size() + 8 + 15) / 16 * 16;
            const std::vector<std::int32_t> head{static_cast<std::int32_t>(size), code};
            blocks += bytesOf(head, big) + content + std::string(size - 8 - content.size(), '\0');
        }
        if (!single) return header.header() + blocks;
        const auto offset = header.header().size() + blocks.size();
        if (version == 1)
            header.set<float>(108, static_cast<float>(offset));
        else
            header.set<std::int64_t>(168, static_cast<std::int64_t>(offset));
        return header.header() + blocks + "\1\7";
    }

    static void expectLabels(const Loaded& loaded, const std::string& what) {
        EXPECT_EQ(loaded.values<unsigned char>(), (std::vector<unsigned char>{1, 7})) << what;
        const auto& labels = loaded.meta().labels;
        ASSERT_EQ(labels.size(), 2U) << what;
        EXPECT_EQ(labels[0].value, 1) << what;
        EXPECT_EQ(labels[0].name, "spleen") << what;
        EXPECT_EQ(labels[0].rgb, glm::dvec3(1.0, 0.25, 0.0)) << what;
        EXPECT_EQ(labels[1].name, "disc & L1") << what;
        EXPECT_FALSE(labels[1].rgb) << what << ": 2 is no part of a colour";
        EXPECT_TRUE(loaded.meta().notes.empty()) << what;
    }

    [[nodiscard]] std::string note(const std::string& content) const {
        const auto loaded = load(write("x.nii", file(1, false, {{30, content}})));
        EXPECT_EQ(loaded.values<unsigned char>(), (std::vector<unsigned char>{1, 7}));
        return loaded.meta().notes.empty() ? "" : loaded.meta().notes[0];
    }
};

TEST_F(NiftiLabels, NamesAndColoursOfEveryVersionOrderAndKindOfFile) {
    for (const int version : {1, 2})
        for (const bool big : {false, true})
            for (const int code : {30, 0}) {
                const std::vector<std::pair<int, std::string>> extensions{{6, "a comment"},
                                                                          {code, table(kLabels)}};
                const auto what = "version " + std::to_string(version) + (big ? ", big-endian" : "") +
                                  ", code " + std::to_string(code);
                const auto single = file(version, big, extensions);
                expectLabels(load(write("x.nii", single)), what);
                expectLabels(load(write("x.nii.gz", gzipped(single))), what + ", gzip");
                write("p.img", "\1\7");
                expectLabels(load(write("p.hdr", file(version, big, extensions, false))), what + ", pair");
                expectLabels(load(folder_ / "p.img"), what + ", image of a pair");
            }
}

TEST_F(NiftiLabels, TheFirstOfSeveralTablesCounts) {
    auto xml = table(kLabels);
    xml.insert(xml.find("</CaretExtension>"),
               R"(<VolumeInformation Index="1"><LabelTable><Label Key="2" Red="1" )"
               R"(Green="1" Blue="1">no</Label></LabelTable></VolumeInformation>)");
    expectLabels(load(write("x.nii", file(1, false, {{30, xml}}))), "two tables");
}

TEST_F(NiftiLabels, AttributesOfAfniHoldATable) {
    const std::string attributes =
        "<?xml version='1.0' ?>\n<AFNI_attributes ni_form=\"ni_group\" >\n"
        "<AFNI_atr ni_type=\"String\" ni_dimen=\"1\" atr_name=\"HISTORY_NOTE\" > \"made by hand\" "
        "</AFNI_atr>\n"
        "<AFNI_atr ni_type=\"String\" ni_dimen=\"1\" atr_name=\"VALUE_LABEL_DTABLE\" >\n"
        " \"&lt;VALUE_LABEL_DTABLE&#x0a; ni_type=&quot;2*String&quot; &gt;&#x0a; &quot;1&quot; "
        "&quot;spleen&quot;"
        "&#x0a; &quot;7&quot; &quot;disc &amp;amp; "
        "L1&quot;&#x0a;&lt;/VALUE_LABEL_DTABLE&gt;&#x0a;\"\n</AFNI_atr>\n"
        "</AFNI_attributes>";
    const auto loaded = load(write("x.nii", file(1, false, {{4, attributes}})));
    const auto& labels = loaded.meta().labels;
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0].value, 1);
    EXPECT_EQ(labels[0].name, "spleen");
    EXPECT_EQ(labels[1].name, "disc & L1");
    EXPECT_FALSE(labels[1].rgb);
    const auto cut = attributes.substr(0, attributes.find("spleen"));
    EXPECT_TRUE(load(write("x.nii", file(1, false, {{4, cut}}))).meta().labels.empty());
}

TEST_F(NiftiLabels, DamagedTablesAreSaidAndTheVolumeIsRead) {
    expectMentions(note(table(kLabels + "<Label>")), "left out: line 1: mismatched tag");
    expectMentions(note("<CaretExtension><LabelTable>"), "left out");
    expectMentions(note(table(R"(<Label Key="x">a</Label><Label Key="1">b</Label><Label Key="1">c</Label>)")),
                   "2 labels of its header were left out");
    expectMentions(note("<!DOCTYPE a [<!ENTITY b \"c\">]>" + table("&b;").substr(39)), "document type");
    EXPECT_EQ(note("<Other/>"), "");
    EXPECT_EQ(note(table("")), "");
}

TEST_F(NiftiLabels, ExtensionsThatLieAreNotFollowed) {
    for (const std::int32_t size : {-1, 0, 7, 1 << 30}) {
        auto bytes = file(1, false, {{30, table(kLabels)}});
        bytes.replace(352, 4, bytesOf(std::vector{size}));
        const auto loaded = load(write("x.nii", bytes));
        EXPECT_TRUE(loaded.meta().labels.empty()) << size;
    }
    auto none = file(1, false, {{30, table(kLabels)}});
    none[348] = '\0'; // says that there are none
    EXPECT_TRUE(load(write("x.nii", none)).meta().labels.empty());
}

} // namespace
} // namespace voxsheet::import::testing
