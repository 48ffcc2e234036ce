#include "cli/demo/crystal_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace voxsheet::cli {

namespace {

using std::numbers::pi;

constexpr double kDisplacementB = 0.5;  ///< Å^2, of the order of room-temperature silicates
constexpr double kCutoffAngstrom = 6.0; ///< the widest Gaussian has fallen to 1e-8 of its centre
constexpr int kRadialEntries = 1 << 16;

struct ScatteringFactor {
    const char* name;
    int electrons;
    int charge; ///< formal, for the relaxation model
    std::array<double, 5> a;
    std::array<double, 5> b;
};

constexpr std::array<ScatteringFactor, 3> kElements{{
    {"Mg", 12, +2, {5.4204, 2.1735, 1.2269, 2.3073, 0.8584}, {2.8275, 79.2611, 0.3808, 7.1937, 0.0}},
    {"Si", 14, +4, {6.2915, 3.0353, 1.9891, 1.5410, 1.1407}, {2.4386, 32.3337, 0.6785, 81.6937, 0.0}},
    {"O", 8, -2, {3.0485, 2.2868, 1.5463, 0.8670, 0.2508}, {13.2771, 5.7011, 0.3239, 32.9089, 0.0}},
}};

const ScatteringFactor& factor(Element element) { return kElements[static_cast<std::size_t>(element)]; }

/// The eight general positions of Pbnm.
std::array<glm::dvec3, 8> equivalentPositions(const glm::dvec3& p) {
    return {{{p.x, p.y, p.z},
             {p.x + 0.5, 0.5 - p.y, -p.z},
             {0.5 - p.x, p.y + 0.5, 0.5 - p.z},
             {-p.x, -p.y, p.z + 0.5},
             {-p.x, -p.y, -p.z},
             {0.5 - p.x, p.y + 0.5, p.z},
             {p.x + 0.5, 0.5 - p.y, p.z + 0.5},
             {p.x, p.y, 0.5 - p.z}}};
}

glm::dvec3 wrapped(glm::dvec3 p) {
    p -= glm::floor(p);
    for (int axis = 0; axis < 3; ++axis)
        if (p[axis] > 1.0 - 1e-9) p[axis] = 0.0;
    return p;
}

/// Shortest vector from a to b under periodic boundaries, in Å.
glm::dvec3 nearestImage(const Supercell& cell, const glm::dvec3& a, const glm::dvec3& b) {
    auto d = b - a;
    d -= glm::round(d);
    return d * cell.lengths;
}

/// atomDensity as a table over r^2, linear in between: the sum over atoms is then one look-up per sample.
std::vector<double> radialTable(Element element) {
    std::vector<double> table(kRadialEntries + 1);
    const double step = kCutoffAngstrom * kCutoffAngstrom / kRadialEntries;
    for (int i = 0; i <= kRadialEntries; ++i)
        table[static_cast<std::size_t>(i)] = atomDensity(element, i * step);
    return table;
}

struct Density {
    const Supercell& cell;
    glm::ivec3 dims;
    std::vector<double> values;

    void addAtom(const Site& site, const std::vector<double>& table) {
        const glm::dvec3 spacing = cell.lengths / glm::dvec3(dims);
        const glm::dvec3 centre = site.fractional * glm::dvec3(dims);
        const glm::ivec3 reach(glm::ceil(glm::dvec3(kCutoffAngstrom) / spacing));
        const glm::ivec3 middle(glm::floor(centre));
        for (int k = middle.z - reach.z; k <= middle.z + reach.z; ++k)
            for (int j = middle.y - reach.y; j <= middle.y + reach.y; ++j)
                addRow(table, centre, spacing, middle, reach, j, k);
    }

    void addRow(const std::vector<double>& table, const glm::dvec3& centre, const glm::dvec3& spacing,
                const glm::ivec3& middle, const glm::ivec3& reach, int j, int k) {
        const double dy = (j - centre.y) * spacing.y;
        const double dz = (k - centre.z) * spacing.z;
        const double rest = dy * dy + dz * dz;
        constexpr double cutoff2 = kCutoffAngstrom * kCutoffAngstrom;
        if (rest >= cutoff2) return;
        const auto wrap = [](int index, int n) { return ((index % n) + n) % n; };
        double* row =
            values.data() + static_cast<std::ptrdiff_t>(dims.x) *
                                (wrap(j, dims.y) + static_cast<std::ptrdiff_t>(dims.y) * wrap(k, dims.z));
        for (int i = middle.x - reach.x; i <= middle.x + reach.x; ++i) {
            const double dx = (i - centre.x) * spacing.x;
            const double r2 = dx * dx + rest;
            if (r2 >= cutoff2) continue;
            const double position = r2 * (kRadialEntries / cutoff2);
            const auto entry = static_cast<std::size_t>(position);
            const double t = position - static_cast<double>(entry);
            row[wrap(i, dims.x)] += (1.0 - t) * table[entry] + t * table[entry + 1];
        }
    }
};

} // namespace

const char* elementName(Element element) noexcept { return factor(element).name; }

int electronCount(Element element) noexcept { return factor(element).electrons; }

Supercell perovskite60() {
    struct AsymmetricSite {
        Element element;
        glm::dvec3 position;
    };
    const std::array<AsymmetricSite, 4> asymmetric{{{Element::Mg, {0.514, 0.556, 0.25}},
                                                    {Element::Si, {0.5, 0.0, 0.5}},
                                                    {Element::O, {0.103, 0.466, 0.25}},
                                                    {Element::O, {0.196, 0.201, 0.553}}}};
    constexpr int cells = 3;
    Supercell cell;
    cell.lengths = {cells * 4.775, 4.929, 6.897};
    for (const auto& [element, position] : asymmetric) {
        std::vector<glm::dvec3> distinct;
        for (const auto& image : equivalentPositions(position)) {
            const auto p = wrapped(image);
            const bool known = std::any_of(distinct.begin(), distinct.end(),
                                           [&](const glm::dvec3& q) { return glm::distance(p, q) < 1e-6; });
            if (!known) distinct.push_back(p);
        }
        for (const auto& p : distinct)
            for (int n = 0; n < cells; ++n)
                cell.sites.push_back({element, {(p.x + n) / cells, p.y, p.z}});
    }
    return cell;
}

Supercell withVacancy(const Supercell& perfect, Element element) {
    const glm::dvec3 middle(0.5);
    auto lost = perfect.sites.end();
    for (auto site = perfect.sites.begin(); site != perfect.sites.end(); ++site) {
        if (site->element != element) continue;
        const auto distance = [&](const Site& s) {
            return glm::length((s.fractional - middle) * perfect.lengths);
        };
        if (lost == perfect.sites.end() || distance(*site) < distance(*lost) - 1e-9) lost = site;
    }
    Supercell cell = perfect;
    cell.sites.clear();
    for (const auto& site : perfect.sites) {
        if (&site == &*lost) continue;
        const auto away = nearestImage(perfect, lost->fractional, site.fractional);
        const double distance = glm::length(away);
        auto moved = site;
        if (distance < kCutoffAngstrom) {
            const double sign = factor(site.element).charge * factor(element).charge < 0 ? 1.0 : -1.0;
            const double shift = sign * 0.12 * std::exp(-(distance - 1.8) / 1.2);
            moved.fractional = wrapped(site.fractional + shift * away / distance / perfect.lengths);
        }
        cell.sites.push_back(moved);
    }
    return cell;
}

double atomDensity(Element element, double r2) {
    const auto& terms = factor(element);
    double density = 0.0;
    for (std::size_t i = 0; i < terms.a.size(); ++i) {
        const double width = terms.b[i] + kDisplacementB;
        density += terms.a[i] * std::pow(4.0 * pi / width, 1.5) * std::exp(-4.0 * pi * pi * r2 / width);
    }
    return density;
}

std::vector<double> electronDensity(const Supercell& cell, const glm::ivec3& dims) {
    Density density{cell, dims,
                    std::vector<double>(static_cast<std::size_t>(dims.x) * static_cast<std::size_t>(dims.y) *
                                        static_cast<std::size_t>(dims.z))};
    const std::array<std::vector<double>, 3> tables{radialTable(Element::Mg), radialTable(Element::Si),
                                                    radialTable(Element::O)};
    for (const auto& site : cell.sites)
        density.addAtom(site, tables[static_cast<std::size_t>(site.element)]);
    return std::move(density.values);
}

} // namespace voxsheet::cli
