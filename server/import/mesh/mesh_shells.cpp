#include "import/mesh/mesh_shells.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/gtc/constants.hpp>

namespace voxsheet::import {

namespace {

constexpr std::size_t mostShells = 20'000;

void turn(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

struct Shell {
    std::vector<std::uint32_t> triangles;
    Bounds bounds{};
    double volume = 0.0; ///< positive if it faces outwards
    bool dropped = false;
    int windingOutside = 0; ///< of the kept shells about it
};

/// One shell by going from neighbour to neighbour; turns what faces the other way than most.
class ShellWalk {
public:
    ShellWalk(TriangleMesh& mesh, const MeshEdges& edges, const std::string& file)
        : mesh_(mesh), edges_(edges), file_(file), state_(mesh.triangles.size(), State::New) {}

    std::vector<Shell> walk(std::size_t& turnedTriangles) {
        std::vector<Shell> shells;
        for (std::uint32_t seed = 0; seed < state_.size(); ++seed) {
            if (state_[seed] != State::New) continue;
            if (shells.size() == mostShells)
                throw LimitExceeded(file_,
                                    "it has more than " + std::to_string(mostShells) + " separate shells",
                                    "join them, or keep the largest ones");
            shells.push_back({walkShell(seed), {}, 0.0, false, 0});
            turnedTriangles += turnMinority(shells.back());
        }
        return shells;
    }

private:
    enum class State : unsigned char { New, AsSeed, OtherWay };

    std::vector<std::uint32_t> walkShell(std::uint32_t seed) {
        std::vector<std::uint32_t> found{seed};
        state_[seed] = State::AsSeed;
        for (std::size_t next = 0; next < found.size(); ++next)
            for (std::size_t s = 0; s < 3; ++s) {
                const auto side = static_cast<Side>(3 * found[next] + s);
                const auto partner = edges_.partner[side];
                // Two triangles that face the same way run along their edge in opposite directions.
                const bool sameWay = beginOf(mesh_.triangles, side) == endOf(mesh_.triangles, partner);
                const bool asSeed = (state_[found[next]] == State::AsSeed) == sameWay;
                const auto wanted = asSeed ? State::AsSeed : State::OtherWay;
                auto& state = state_[partner / 3];
                if (state == State::New) {
                    state = wanted;
                    found.push_back(partner / 3);
                } else if (state != wanted) {
                    throw InvalidInput(file_,
                                       "its surface has one side only, like a Moebius strip, near " +
                                           pointText(mesh_.corner(found[next], s)),
                                       "a clip object needs an inside: make the surface bound a solid");
                }
            }
        return found;
    }

    std::size_t turnMinority(const Shell& shell) {
        const auto others = static_cast<std::size_t>(
            std::count_if(shell.triangles.begin(), shell.triangles.end(),
                          [&](std::uint32_t t) { return state_[t] == State::OtherWay; }));
        const auto minority = 2 * others > shell.triangles.size() ? State::AsSeed : State::OtherWay;
        std::size_t turned = 0;
        for (const auto t : shell.triangles)
            if (state_[t] == minority) {
                ++turned;
                toTurn_.push_back(t);
            }
        return turned;
    }

public:
    /// After walk: its edges stay valid until here.
    void turnCollected() {
        for (const auto t : toTurn_)
            turn(mesh_.triangles[t]);
    }

private:
    TriangleMesh& mesh_;
    const MeshEdges& edges_;
    const std::string& file_;
    std::vector<State> state_;
    std::vector<std::uint32_t> toTurn_;
};

void measure(const TriangleMesh& mesh, Shell& shell) {
    const auto origin = mesh.corner(shell.triangles[0], 0);
    shell.bounds = {origin, origin};
    for (const auto t : shell.triangles) {
        const auto a = mesh.corner(t, 0) - origin;
        const auto b = mesh.corner(t, 1) - origin;
        const auto c = mesh.corner(t, 2) - origin;
        shell.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        for (std::size_t i = 0; i < 3; ++i) {
            shell.bounds.low = glm::min(shell.bounds.low, mesh.corner(t, i));
            shell.bounds.high = glm::max(shell.bounds.high, mesh.corner(t, i));
        }
    }
    const auto extent = shell.bounds.high - shell.bounds.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    shell.dropped = !(std::abs(shell.volume) > 1e-12 * longest * longest * longest);
}

/// Solid angles of the triangles, summed: 4 pi times the winding number (van Oosterom & Strackee 1983).
bool encloses(const TriangleMesh& mesh, const Shell& shell, const glm::dvec3& point) {
    if (glm::any(glm::lessThan(point, shell.bounds.low)) ||
        glm::any(glm::greaterThan(point, shell.bounds.high)))
        return false;
    double angle = 0.0;
    for (const auto t : shell.triangles) {
        const auto a = mesh.corner(t, 0) - point;
        const auto b = mesh.corner(t, 1) - point;
        const auto c = mesh.corner(t, 2) - point;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        angle +=
            2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                             la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return std::abs(angle) > glm::two_pi<double>();
}

/// Larger shells first, so that those about a shell are settled before it.
void settleNesting(TriangleMesh& mesh, std::vector<Shell>& shells, ShellCounts& counts) {
    std::vector<Shell*> order;
    for (auto& shell : shells)
        if (!shell.dropped) order.push_back(&shell);
    counts.flatShells = shells.size() - order.size();
    std::stable_sort(order.begin(), order.end(),
                     [](auto* a, auto* b) { return std::abs(a->volume) > std::abs(b->volume); });
    for (auto* const shell : order) {
        const auto t = shell->triangles[0];
        const auto inside = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        for (auto* const outer : order) {
            if (outer == shell) break;
            if (encloses(mesh, *outer, inside)) shell->windingOutside += outer->volume > 0.0 ? 1 : -1;
        }
        if (shell->windingOutside == 0 && shell->volume < 0.0) {
            for (const auto triangle : shell->triangles)
                turn(mesh.triangles[triangle]);
            shell->volume = -shell->volume;
            ++counts.turnedShells;
        }
        const int windingInside = shell->windingOutside + (shell->volume > 0.0 ? 1 : -1);
        if ((shell->windingOutside > 0) == (windingInside > 0)) {
            shell->dropped = true; // the solid is on both sides of it
            ++counts.innerShells;
        }
    }
}

} // namespace

ShellCounts faceOutwards(TriangleMesh& mesh, const MeshEdges& edges, const std::string& file) {
    ShellCounts counts;
    ShellWalk walk(mesh, edges, file);
    auto shells = walk.walk(counts.turnedTriangles);
    walk.turnCollected();
    for (auto& shell : shells)
        measure(mesh, shell);
    settleNesting(mesh, shells, counts);
    std::vector<bool> kept(mesh.triangles.size(), false);
    for (const auto& shell : shells) {
        counts.shells += shell.dropped ? 0 : 1;
        for (const auto t : shell.triangles)
            kept[t] = !shell.dropped;
    }
    std::vector<Triangle> remaining;
    for (std::size_t t = 0; t < kept.size(); ++t)
        if (kept[t]) remaining.push_back(mesh.triangles[t]);
    mesh.triangles = std::move(remaining);
    return counts;
}

} // namespace voxsheet::import
