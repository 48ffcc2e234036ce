// Surfaces made by the tests, and their files in every format.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace voxsheet::import::testing {

struct TestMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< anticlockwise from outside
};

inline void append(TestMesh& mesh, const TestMesh& more, const glm::dvec3& offset = glm::dvec3(0.0)) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const auto& point : more.points)
        mesh.points.push_back(point + offset);
    for (auto triangle : more.triangles) {
        for (auto& corner : triangle)
            corner += first;
        mesh.triangles.push_back(triangle);
    }
}

/// An octahedron whose faces are divided `divisions` times, its points on the sphere.
inline TestMesh sphereMesh(double radius, int divisions) {
    TestMesh mesh;
    mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int division = 0; division < divisions; ++division) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                            static_cast<std::uint32_t>(mesh.points.size()));
            if (fresh) mesh.points.push_back(glm::normalize(mesh.points[a] + mesh.points[b]));
            return entry->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto ab = middle(a, b);
            const auto bc = middle(b, c);
            const auto ca = middle(c, a);
            for (const auto& part : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                                     std::array{ab, bc, ca}})
                finer.push_back(part);
        }
        mesh.triangles = std::move(finer);
    }
    for (auto& point : mesh.points)
        point *= radius;
    return mesh;
}

/// [-half, half]^3.
inline TestMesh cubeMesh(double half) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.points.emplace_back((i & 1U) != 0 ? half : -half, (i & 2U) != 0 ? half : -half,
                                 (i & 4U) != 0 ? half : -half);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

inline TestMesh torusMesh(double major, double minor, std::uint32_t around, std::uint32_t across) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2.0 * std::numbers::pi * i / around;
            const double v = 2.0 * std::numbers::pi * j / across;
            const double r = major + minor * std::cos(v);
            mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
        }
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const auto at = [&](std::uint32_t a, std::uint32_t b) {
                return (a % around) * across + b % across;
            };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

inline void flipped(TestMesh& mesh) {
    for (auto& triangle : mesh.triangles)
        std::swap(triangle[1], triangle[2]);
}

template <typename T>
void put(std::string& bytes, T value, bool bigEndian = false) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (bigEndian)
        bytes.append(one.rbegin(), one.rend());
    else
        bytes += one;
}

inline std::string binaryStl(const TestMesh& mesh) {
    std::string bytes(80, ' ');
    put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            put(bytes, 0.0F);
        for (const auto corner : triangle)
            for (int axis = 0; axis < 3; ++axis)
                put(bytes, static_cast<float>(mesh.points[corner][axis]));
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

inline std::string textStl(const TestMesh& mesh) {
    std::ostringstream out;
    out.precision(17);
    out << "solid test\n";
    for (const auto& triangle : mesh.triangles) {
        out << " facet normal 0 0 0\n  outer loop\n";
        for (const auto corner : triangle)
            out << "   vertex " << mesh.points[corner].x << " " << mesh.points[corner].y << " "
                << mesh.points[corner].z << "\n";
        out << "  endloop\n endfacet\n";
    }
    out << "endsolid test\n";
    return out.str();
}

inline std::string obj(const TestMesh& mesh) {
    std::ostringstream out;
    out.precision(17);
    out << "# test\no test\n";
    for (const auto& p : mesh.points)
        out << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (const auto& t : mesh.triangles)
        out << "f " << t[0] + 1 << "//1 " << t[1] + 1 << "//1 " << t[2] + 1 << "//1\n";
    return out.str();
}

inline std::string plyHeader(const TestMesh& mesh, const std::string& format) {
    return "ply\nformat " + format + " 1.0\ncomment test\nelement vertex " +
           std::to_string(mesh.points.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string textPly(const TestMesh& mesh) {
    std::ostringstream out;
    out.precision(17);
    out << plyHeader(mesh, "ascii");
    for (const auto& p : mesh.points)
        out << p.x << " " << p.y << " " << p.z << "\n";
    for (const auto& t : mesh.triangles)
        out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    return out.str();
}

inline std::string binaryPly(const TestMesh& mesh, bool bigEndian) {
    std::string bytes = plyHeader(mesh, bigEndian ? "binary_big_endian" : "binary_little_endian");
    for (const auto& p : mesh.points)
        for (int axis = 0; axis < 3; ++axis)
            put(bytes, static_cast<float>(p[axis]), bigEndian);
    for (const auto& t : mesh.triangles) {
        put(bytes, std::uint8_t{3});
        for (const auto corner : t)
            put(bytes, static_cast<std::int32_t>(corner), bigEndian);
    }
    return bytes;
}

} // namespace voxsheet::import::testing
