// Parsers that stand before or beside a reader.
#include "fuzz_target.h"

#include "base/errors.h"
#include "import/formats/label_lookup.h"
#include "import/formats/label_names.h"
#include "import/formats/point_resampling.h"
#include "import/vtk_xml/amr_header.h"
#include "import/vtk_xml/vti_header.h"
#include "scratch_folder.h"

#include <cmath>
#include <set>

namespace voxsheet::fuzz {

namespace {

using namespace import;

void checkLabels(const std::vector<LabelMeta>& labels) {
    std::set<std::int64_t> values;
    for (const auto& label : labels) {
        promise(values.insert(label.value).second, "a value twice");
        promise(label.name.size() <= 1000, "an endless name");
        for (int channel = 0; label.rgb && channel < 3; ++channel)
            promise((*label.rgb)[channel] >= 0.0 && (*label.rgb)[channel] <= 1.0, "a colour beyond [0, 1]");
    }
}

FuzzTarget labelLookup() {
    return {
        "label_lookup",
        {"# ITK-SnAP Label Description File\n 0 0 0 0 0 0 0 \"Clear Label\"\n 7 255 0 51 1 1 1 \"left "
         "\"L\"\"\n",
         "#No. Label Name: R G B A\n0 Unknown 0 0 0 0\n14 3rd-Ventricle 204 182 142 0\n9 a b 1 2 3 0\n",
         "index\tname\tabbreviation\tcolor\n2\tWhite Matter\tWM\t#00ff00\n1\tGray\tGM\tn/a\n",
         "<VALUE_LABEL_DTABLE ni_type=\"2*String\">\"0\" \"Unknown\" 17 'L &amp; R'</VALUE_LABEL_DTABLE>\n",
         "<atlas><header><type>Probabilistic</type></header><data><label index=\"0\" "
         "color=\"#ff0033\">Frontal Pole</label><label value=\"7\">b</label></data></atlas>\n"},
        [](std::string_view text) {
            if (const auto lookup = parseLabelLookup(text)) checkLabels(lookup->labels);
        }};
}

FuzzTarget labelSidecar() {
    return {
        "label_sidecar",
        {R"({"labels": {"1": "liver", "2": {"name": "spleen", "colour": "#aa3300"}, "-3": {"color": "#000000"}}})"},
        [](std::string_view text) {
            scratchFolder().write("input.labels.json", text);
            checkLabels(readLabelSidecar(InputFile(scratchFolder().path() / "input.labels.json")));
        }};
}

FuzzTarget vtiHeader() {
    const std::string head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
                             "byte_order=\"LittleEndian\" header_type=\"UInt32\"";
    const std::string image = ">\n<ImageData WholeExtent=\"0 1 0 2 0 3\" Origin=\"0 0 0\" Spacing=\"1 2 3\" "
                              "Direction=\"1 0 0 0 1 0 0 0 1\">\n<Piece Extent=\"0 1 0 2 0 3\">\n";
    const std::string end = "</Piece></ImageData>\n";
    return {
        "vti_header",
        {head + image +
             "<CellData><DataArray type=\"UInt8\" Name=\"v\" format=\"ascii\">1 2 3 4 5 "
             "6</DataArray></CellData>" +
             end + "</VTKFile>\n",
         head + " compressor=\"vtkZLibDataCompressor\"" + image +
             "<CellData><DataArray type=\"UInt8\" Name=\"v\" format=\"appended\" offset=\"0\"/></CellData>" +
             end +
             "<AppendedData "
             "encoding=\"base64\">\n_AQAAAACAAAAGAAAADgAAAA==eJxjZGJmYWVjBwAAQAAW\n</AppendedData>"
             "</VTKFile>\n",
         head + image +
             "<PointData Vectors=\"m\"><DataArray type=\"Int8\" Name=\"m\" NumberOfComponents=\"3\" "
             "format=\"binary\"><InformationKey name=\"L2_NORM_RANGE\"><Value index=\"0\">0.5</Value>"
             "</InformationKey>SAAAAA==</DataArray></PointData>" +
             end + "</VTKFile>\n"},
        [](std::string_view bytes) {
            scratchFolder().write("input.vti", bytes);
            const InputFile file(scratchFolder().path() / "input.vti");
            const auto header = parseVtiHeader(file);
            promise(header.points.dims.x > 0 && header.points.dims.y > 0 && header.points.dims.z > 0,
                    "an image without points");
            for (const auto& array : header.arrays)
                try {
                    checkVtiArray(file, header, array, 6 * scalarBytes(array.type));
                } catch (const Error&) { // an answer; the others are asked, too
                }
        }};
}

FuzzTarget amrHeader() {
    return {"amr_header",
            {"<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\"><vtkOverlappingAMR origin=\"0 0 0\">"
             "<Block level=\"0\" spacing=\"2 2 2\"><DataSet index=\"0\" amr_box=\"0 1 0 1 0 0\" "
             "file=\"p/c.vti\"/>"
             "<DataSet index=\"1\"/></Block><Block level=\"1\"><DataSet file=\"p/f.vti\"/></Block>"
             "</vtkOverlappingAMR></VTKFile>",
             "<VTKFile type=\"vtkHierarchicalBoxDataSet\" version=\"0.1\"><vtkHierarchicalBoxDataSet>"
             "<DataSet group=\"1\" dataset=\"0\" file=\"f.vti\"/><DataSet group=\"0\" file=\"c.vti\"/>"
             "</vtkHierarchicalBoxDataSet></VTKFile>"},
            [](std::string_view bytes) {
                scratchFolder().write("input.vth", bytes);
                const auto patches = parseAmrHeader(InputFile(scratchFolder().path() / "input.vth"));
                promise(!patches.empty(), "no patches");
                for (std::size_t i = 1; i < patches.size(); ++i)
                    promise(patches[i - 1].level <= patches[i].level, "patches out of order");
            }};
}

/// Geometry is no text, but comes from files all the same: numbers of one byte each.
/// Of patches whose values are all 7.
void paintAll(const Resampling& resampling, const std::vector<CellPatch>& all) {
    promise(sampleCount(resampling.grid().dims) <= (1 << 20), "a grid beyond the bound");
    auto samples = resampling.blank(ScalarType::U8);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::vector<std::uint8_t> values(static_cast<std::size_t>(sampleCount(all[i].dims)),
                                               std::uint8_t{7});
        resampling.paint(i, std::as_bytes(std::span(values)), ScalarType::U8, samples);
    }
}

FuzzTarget patches() {
    return {"patch_resampling",
            {std::string("\x00\x02\x00\x00\x00\x02\x02\x01\x01\x01\x02\x00\x00\x02\x02\x02", 16)},
            [](std::string_view bytes) {
                std::vector<CellPatch> all;
                for (std::size_t at = 0; at + 8 <= bytes.size() && all.size() < 16; at += 8) {
                    const auto number = [&](std::size_t i) {
                        return static_cast<unsigned char>(bytes[at + i]);
                    };
                    CellPatch patch;
                    patch.level = all.empty() ? 0 : all.back().level + number(0) % 2;
                    patch.cellSize = glm::dvec3(std::ldexp(1.0 + number(1) % 3, -2 * patch.level));
                    patch.low = 0.25 * glm::dvec3(number(2), number(3), number(4));
                    patch.dims = glm::ivec3(1) + glm::ivec3(number(5), number(6), number(7)) % 9;
                    all.push_back(patch);
                }
                if (all.empty()) return;
                paintAll(PatchResampling("input", all), all);
                paintAll(PointResampling("input", all), all);
            }};
}

} // namespace

std::vector<FuzzTarget> parserTargets() {
    return {labelLookup(), labelSidecar(), vtiHeader(), amrHeader(), patches()};
}

} // namespace voxsheet::fuzz
