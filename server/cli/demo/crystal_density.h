// Electron density of MgSiO3 perovskite in the independent-atom model: what the demo compares, cell by cell.
//
// Structure: Pbnm, a = 4.775, b = 4.929, c = 6.897 Å, after Horiuchi, Ito & Weidner, Am. Mineral. 72 (1987)
// 357. Three cells along a make the 60 sites of the core paper (seed 002, figure 1).
//
// Atoms: neutral, spherical; the X-ray scattering factors of International Tables for Crystallography C,
// table 6.1.1.4 (after Cromer & Mann 1968), f(s) = sum_i a_i exp(-b_i s^2) + c with s = sin(theta)/lambda,
// smeared by an isotropic displacement factor B, give the density in closed form:
//   rho(r) = sum_i a_i (4 pi / (b_i + B))^(3/2) exp(-4 pi^2 r^2 / (b_i + B))   (c counts as a term with b =
//   0).
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace voxsheet::cli {

enum class Element { Mg, Si, O };

struct Site {
    Element element;
    glm::dvec3 fractional; ///< in [0, 1) of the supercell
};

struct Supercell {
    glm::dvec3 lengths{0.0}; ///< of the orthogonal lattice vectors, in Å
    std::vector<Site> sites; ///< ordered Mg, Si, O
};

[[nodiscard]] const char* elementName(Element element) noexcept;
[[nodiscard]] int electronCount(Element element) noexcept;

/// The perfect crystal: 12 Mg, 12 Si, 36 O.
[[nodiscard]] Supercell perovskite60();

/// Without the site of `element` nearest to the middle. Neighbours relax by a model, not by a calculation: a
/// site at distance d from the vacancy moves along the line through both by sign * 0.12 Å * exp(-(d - 1.8 Å)
/// / 1.2 Å), away from it when its charge is opposite to the lost ion's, towards it otherwise; within 6 Å.
[[nodiscard]] Supercell withVacancy(const Supercell& perfect, Element element);

/// Density of one free atom at squared distance r2 (Å^2), in electrons per Å^3.
[[nodiscard]] double atomDensity(Element element, double r2);

/// rho at sample (i, j, k) at fractional position (i/nx, j/ny, k/nz), x fastest, in electrons per Å^3;
/// periodic.
[[nodiscard]] std::vector<double> electronDensity(const Supercell& cell, const glm::ivec3& dims);

} // namespace voxsheet::cli
