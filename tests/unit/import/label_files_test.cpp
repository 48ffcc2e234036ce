// Names of labels from files beside a volume: which files, and what is in them.
#include "import/formats/label_files.h"

#include "import/formats/label_lookup.h"

#include "formats_fixture.h"

namespace voxsheet::import::testing {
namespace {

constexpr const char* kSnap = "################################################\n"
                              "# ITK-SnAP Label Description File\n"
                              "# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL\n"
                              "################################################\n"
                              "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                              "    7   255    0   51        1  1  1    \"left kidney (\"L\")\"\n"
                              "   12     0  255    0     0.25  1  0    \"Label 12\"\r\n";
constexpr const char* kFreeSurfer = "#$Id: a table $\n"
                                    "#No. Label Name:                            R   G   B   A\n\n"
                                    "0   Unknown                                 0   0   0   0\n"
                                    "14  3rd-Ventricle                           204 182 142 0\n"
                                    "1001 L.BSTS ctx-lh-bankssts                 25 100 40 255\n";
constexpr const char* kBids = "index\tname\tabbreviation\tcolor\tmapping\n"
                              "2\tWhite Matter\tWM\t#00ff00\t2\n"
                              "1\tGray Matter\tGM\tn/a\t1\n";

constexpr const char* kAfni = "<VALUE_LABEL_DTABLE\n ni_type=\"2*String\"\n ni_dimen=\"3\" >\n"
                              " \"17\" \"Left-Hippocampus\"\n \"0\" 'Unknown'\n"
                              " 53 \"R &amp; &lt;hippo&gt;\"\n</VALUE_LABEL_DTABLE>\n";
std::string fslAtlas(const std::string& type, const std::string& labels) {
    return "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<atlas version=\"1.0\"><header><name>A "
           "B</name><type>" +
           type + "</type></header><data>\n" + labels + "</data></atlas>\n";
}
constexpr const char* kFslLabels = "<label index=\"0\" x=\"48\" y=\"94\" z=\"35\">Frontal Pole</label>\n"
                                   "<label index=\"1\" x=\"25\" y=\"70\" z=\"32\" color=\"#ff0033\">Insular "
                                   "&amp; more</label>\n";

class LabelFiles : public FormatsTest {
protected:
    /// The labels of a volume of this name, after what lies beside it.
    [[nodiscard]] SourceHeader headerOf(const std::string& name) const {
        const auto file = folder_ / name;
        if (!fs::exists(file)) write(name, "volume");
        SourceHeader header;
        header.files.push_back(fs::canonical(file));
        addLabelFiles(file, header);
        return header;
    }
    [[nodiscard]] std::string firstName(const std::string& name) const {
        const auto labels = headerOf(name).meta.labels;
        return labels.empty() ? "" : labels.front().name;
    }
};

TEST(LabelLookup, DescriptionsOfItkSnap) {
    const auto lookup = parseLabelLookup(kSnap);
    ASSERT_TRUE(lookup);
    ASSERT_EQ(lookup->labels.size(), 3U);
    EXPECT_EQ(lookup->linesLeftOut, 0U);
    EXPECT_EQ(lookup->labels[0].name, "Clear Label");
    EXPECT_EQ(lookup->labels[1].value, 7);
    EXPECT_EQ(lookup->labels[1].name, "left kidney (\"L\")");
    EXPECT_EQ(lookup->labels[1].rgb, glm::dvec3(1.0, 0.0, 0.2));
    EXPECT_EQ(lookup->labels[2].name, "Label 12");
}

TEST(LabelLookup, ColourTablesOfFreeSurfer) {
    const auto lookup = parseLabelLookup(kFreeSurfer);
    ASSERT_TRUE(lookup);
    ASSERT_EQ(lookup->labels.size(), 3U);
    EXPECT_EQ(lookup->labels[1].value, 14);
    EXPECT_EQ(lookup->labels[1].name, "3rd-Ventricle");
    EXPECT_EQ(lookup->labels[1].rgb, glm::dvec3(204.0, 182.0, 142.0) / 255.0);
    EXPECT_EQ(lookup->labels[2].name, "L.BSTS ctx-lh-bankssts");
    EXPECT_EQ(lookup->labels[2].rgb, glm::dvec3(25.0, 100.0, 40.0) / 255.0);
}

TEST(LabelLookup, TablesOfBids) {
    const auto lookup = parseLabelLookup(kBids);
    ASSERT_TRUE(lookup);
    ASSERT_EQ(lookup->labels.size(), 2U);
    EXPECT_EQ(lookup->labels[0].name, "Gray Matter");
    EXPECT_FALSE(lookup->labels[0].rgb);
    EXPECT_EQ(lookup->labels[1].value, 2);
    EXPECT_EQ(lookup->labels[1].rgb, glm::dvec3(0, 1, 0));
    const auto reordered = parseLabelLookup("name\tindex\nliver\t5\n");
    ASSERT_TRUE(reordered);
    EXPECT_EQ(reordered->labels.at(0).value, 5);
    EXPECT_EQ(reordered->labels.at(0).name, "liver");
}

TEST(LabelLookup, TablesOfAfni) {
    for (const auto& text : {std::string(kAfni), "# a comment\n" + std::string(kAfni)}) {
        const auto lookup = parseLabelLookup(text);
        ASSERT_TRUE(lookup);
        ASSERT_EQ(lookup->labels.size(), 3U);
        EXPECT_EQ(lookup->linesLeftOut, 0U);
        EXPECT_EQ(lookup->labels[0].name, "Unknown");
        EXPECT_EQ(lookup->labels[1].value, 17);
        EXPECT_EQ(lookup->labels[1].name, "Left-Hippocampus");
        EXPECT_FALSE(lookup->labels[1].rgb);
        EXPECT_EQ(lookup->labels[2].name, "R & <hippo>");
    }
    const auto odd = parseLabelLookup("<VALUE_LABEL_DTABLE >\"x\" \"a\" \"2\" \"b\" \"2\" \"c\" \"3\"");
    ASSERT_TRUE(odd);
    ASSERT_EQ(odd->labels.size(), 1U);
    EXPECT_EQ(odd->labels[0].name, "b");
    EXPECT_EQ(odd->linesLeftOut, 3U) << "no number, given twice, without a name";
}

TEST(LabelLookup, AtlasesOfFsl) {
    const auto probable = parseLabelLookup(fslAtlas("Probabilistic", kFslLabels));
    ASSERT_TRUE(probable);
    ASSERT_EQ(probable->labels.size(), 2U);
    EXPECT_EQ(probable->labels[0].value, 1) << "index 0 is value 1 where probability is largest";
    EXPECT_EQ(probable->labels[0].name, "Frontal Pole");
    EXPECT_EQ(probable->labels[1].value, 2);
    EXPECT_EQ(probable->labels[1].name, "Insular & more");
    EXPECT_EQ(probable->labels[1].rgb, glm::dvec3(1.0, 0.0, 0.2));
    EXPECT_EQ(parseLabelLookup(fslAtlas("Label", kFslLabels))->labels[1].value, 1) << "an index is a value";
    const auto given =
        parseLabelLookup(fslAtlas("Label", "<label index=\"0\" value=\"70\">a</label><label>b</label>"));
    EXPECT_EQ(given->labels.at(0).value, 70);
    EXPECT_EQ(given->linesLeftOut, 1U);
}

TEST(LabelLookup, OtherTextsAreNoTables) {
    auto damaged = fslAtlas("Label", kFslLabels);
    damaged.resize(damaged.size() - 12);
    EXPECT_FALSE(parseLabelLookup(damaged));
    EXPECT_FALSE(parseLabelLookup("<!DOCTYPE a [<!ENTITY b \"c\">]>" + fslAtlas("Label", "").substr(45)));
    for (const auto* text :
         {"", "\n\n# only a comment\n", "A scan of a head, 2019.\n", "1 2 3 4 5 6\n", "1 liver\n",
          "1 liver 300 0 0 0\n", "<svg><label index=\"1\">a</label></svg>", "<VALUE_LABEL_DTABLE",
          "<VALUE_LABEL_DTABLE />", "1.5 liver 255 0 0 0\n", "1 255 0 0 1 1 \"two switches are missing\"\n",
          "1 255 0 0 1 1 1 \"more after it\" x\n", "onset\tduration\n1\t2\n",
          "#!ascii label\n1 2 3.5 4.5 0\n"})
        EXPECT_FALSE(parseLabelLookup(text)) << text;
}

TEST(LabelLookup, LinesThatAreNoRowsAreCounted) {
    const auto lookup = parseLabelLookup("1 liver 255 0 0 255\nhere is a gap\n1 again 0 0 0 0\n"
                                         "99999999999999999999 large 1 2 3 0\n2 spleen 0 0 255 0\n");
    ASSERT_TRUE(lookup);
    EXPECT_EQ(lookup->labels.size(), 2U);
    EXPECT_EQ(lookup->linesLeftOut, 3U);
    std::string many;
    for (int i = 0; i < 5000; ++i)
        many += std::to_string(i) + " region 1 2 3 0\n";
    EXPECT_EQ(parseLabelLookup(many)->labels.size(), 4096U);
    EXPECT_EQ(parseLabelLookup(many)->linesLeftOut, 904U);
}

TEST_F(LabelFiles, EachNameBesideAVolumeIsTried) {
    for (const std::string ending :
         {".label", ".lut", ".ctbl", ".tsv", ".txt", ".niml.lt", ".lt", ".xml", "_ColorTable.ctbl"}) {
        const auto table = write("scan.v2" + ending, "4 region" + ending + " 1 2 3 0\n");
        for (const auto* volume : {"scan.v2.nii.gz", "scan.v2.nrrd", "scan.v2.mha", "scan.v2.tif"}) {
            const auto header = headerOf(volume);
            ASSERT_EQ(header.meta.labels.size(), 1U) << ending << " beside " << volume;
            EXPECT_EQ(header.meta.labels[0].name, "region" + ending);
            EXPECT_EQ(header.files.at(1), fs::canonical(table));
            expectMentions(header.meta.notes.at(0), "scan.v2" + ending);
        }
        EXPECT_EQ(firstName("scan.nii"), "") << ending;
        fs::remove(table);
    }
}

TEST_F(LabelFiles, TheSidecarGoesBeforeTheFileAndTheFileBeforeALookupTable) {
    write("scan.txt", kFreeSurfer);
    SourceHeader header;
    header.files.push_back(write("scan.nii", "volume"));
    header.meta.labels.push_back({1, "the file's own", std::nullopt});
    addLabelFiles(folder_ / "scan.nii", header);
    ASSERT_EQ(header.meta.labels.size(), 1U);
    EXPECT_EQ(header.meta.labels[0].name, "the file's own");
    write("scan.labels.json", R"({"labels": {"3": "the sidecar's"}})");
    addLabelFiles(folder_ / "scan.nii", header);
    ASSERT_EQ(header.meta.labels.size(), 1U);
    EXPECT_EQ(header.meta.labels[0].name, "the sidecar's");
    EXPECT_EQ(header.files.size(), 2U);
}

TEST_F(LabelFiles, WhatIsNoTableOrLiesElsewhereSaysNothing) {
    write("scan.label", "#!ascii label\n1 2 3.5 4.5 0\n");
    write("scan.txt", std::string(2U << 20, ' '));
    fs::create_directories(folder_ / "scan.lut");
    fs::create_symlink(write("elsewhere/table.tsv", kBids), folder_ / "scan.tsv");
    EXPECT_EQ(firstName("scan.nii"), "Gray Matter") << "a link within the folder";
    fs::create_directories(folder_ / "inside");
    fs::create_symlink(folder_ / "elsewhere/table.tsv", folder_ / "inside/scan.tsv");
    const auto header = headerOf("inside/scan.nii");
    EXPECT_TRUE(header.meta.labels.empty());
    EXPECT_TRUE(header.meta.notes.empty());
    EXPECT_EQ(header.files.size(), 1U);
}

TEST_F(LabelFiles, ATextThatIsTheVolumeItselfIsNoTable) {
    write("scan.txt", kFreeSurfer);
    EXPECT_EQ(firstName("scan.txt"), "");
}

TEST_F(LabelFiles, ASidecarThatIsALinkOutOfTheFolderIsRefused) {
    const auto outside = write("elsewhere/secret.json", R"({"labels": {"1": "secret"}})");
    fs::create_directories(folder_ / "inside");
    fs::create_symlink(outside, folder_ / "inside/scan.labels.json");
    EXPECT_THROW((void)headerOf("inside/scan.nrrd"), InvalidInput);
}

TEST_F(LabelFiles, LinesLeftOutAreSaid) {
    write("scan.txt", "1 liver 255 0 0 255\nhere is a gap\n");
    expectMentions(headerOf("scan.nii").meta.notes.at(1), "1 lines of scan.txt were left out");
}

} // namespace
} // namespace voxsheet::import::testing
