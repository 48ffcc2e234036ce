#include "volume/elements.h"

#include <algorithm>
#include <array>

namespace voxsheet {

namespace {

struct Row {
    std::string_view symbol;
    double covalentRadius;
    unsigned rgb;
};

// Jmol has one colour for meitnerium and all heavier elements.
constexpr std::array<Row, kHeaviestElement> kElements{{
    {"H", 0.31, 0xffffff},  {"He", 0.28, 0xd9ffff}, {"Li", 1.28, 0xcc80ff}, {"Be", 0.96, 0xc2ff00},
    {"B", 0.84, 0xffb5b5},  {"C", 0.76, 0x909090},  {"N", 0.71, 0x3050f8},  {"O", 0.66, 0xff0d0d},
    {"F", 0.57, 0x90e050},  {"Ne", 0.58, 0xb3e3f5}, {"Na", 1.66, 0xab5cf2}, {"Mg", 1.41, 0x8aff00},
    {"Al", 1.21, 0xbfa6a6}, {"Si", 1.11, 0xf0c8a0}, {"P", 1.07, 0xff8000},  {"S", 1.05, 0xffff30},
    {"Cl", 1.02, 0x1ff01f}, {"Ar", 1.06, 0x80d1e3}, {"K", 2.03, 0x8f40d4},  {"Ca", 1.76, 0x3dff00},
    {"Sc", 1.70, 0xe6e6e6}, {"Ti", 1.60, 0xbfc2c7}, {"V", 1.53, 0xa6a6ab},  {"Cr", 1.39, 0x8a99c7},
    {"Mn", 1.39, 0x9c7ac7}, {"Fe", 1.32, 0xe06633}, {"Co", 1.26, 0xf090a0}, {"Ni", 1.24, 0x50d050},
    {"Cu", 1.32, 0xc88033}, {"Zn", 1.22, 0x7d80b0}, {"Ga", 1.22, 0xc28f8f}, {"Ge", 1.20, 0x668f8f},
    {"As", 1.19, 0xbd80e3}, {"Se", 1.20, 0xffa100}, {"Br", 1.20, 0xa62929}, {"Kr", 1.16, 0x5cb8d1},
    {"Rb", 2.20, 0x702eb0}, {"Sr", 1.95, 0x00ff00}, {"Y", 1.90, 0x94ffff},  {"Zr", 1.75, 0x94e0e0},
    {"Nb", 1.64, 0x73c2c9}, {"Mo", 1.54, 0x54b5b5}, {"Tc", 1.47, 0x3b9e9e}, {"Ru", 1.46, 0x248f8f},
    {"Rh", 1.42, 0x0a7d8c}, {"Pd", 1.39, 0x006985}, {"Ag", 1.45, 0xc0c0c0}, {"Cd", 1.44, 0xffd98f},
    {"In", 1.42, 0xa67573}, {"Sn", 1.39, 0x668080}, {"Sb", 1.39, 0x9e63b5}, {"Te", 1.38, 0xd47a00},
    {"I", 1.39, 0x940094},  {"Xe", 1.40, 0x429eb0}, {"Cs", 2.44, 0x57178f}, {"Ba", 2.15, 0x00c900},
    {"La", 2.07, 0x70d4ff}, {"Ce", 2.04, 0xffffc7}, {"Pr", 2.03, 0xd9ffc7}, {"Nd", 2.01, 0xc7ffc7},
    {"Pm", 1.99, 0xa3ffc7}, {"Sm", 1.98, 0x8fffc7}, {"Eu", 1.98, 0x61ffc7}, {"Gd", 1.96, 0x45ffc7},
    {"Tb", 1.94, 0x30ffc7}, {"Dy", 1.92, 0x1fffc7}, {"Ho", 1.92, 0x00ff9c}, {"Er", 1.89, 0x00e675},
    {"Tm", 1.90, 0x00d452}, {"Yb", 1.87, 0x00bf38}, {"Lu", 1.87, 0x00ab24}, {"Hf", 1.75, 0x4dc2ff},
    {"Ta", 1.70, 0x4da6ff}, {"W", 1.62, 0x2194d6},  {"Re", 1.51, 0x267dab}, {"Os", 1.44, 0x266696},
    {"Ir", 1.41, 0x175487}, {"Pt", 1.36, 0xd0d0e0}, {"Au", 1.36, 0xffd123}, {"Hg", 1.32, 0xb8b8d0},
    {"Tl", 1.45, 0xa6544d}, {"Pb", 1.46, 0x575961}, {"Bi", 1.48, 0x9e4fb5}, {"Po", 1.40, 0xab5c00},
    {"At", 1.50, 0x754f45}, {"Rn", 1.50, 0x428296}, {"Fr", 2.60, 0x420066}, {"Ra", 2.21, 0x007d00},
    {"Ac", 2.15, 0x70abfa}, {"Th", 2.06, 0x00baff}, {"Pa", 2.00, 0x00a1ff}, {"U", 1.96, 0x008fff},
    {"Np", 1.90, 0x0080ff}, {"Pu", 1.87, 0x006bff}, {"Am", 1.80, 0x545cf2}, {"Cm", 1.69, 0x785ce3},
    {"Bk", 1.60, 0x8a4fe3}, {"Cf", 1.60, 0xa136d4}, {"Es", 1.60, 0xb31fd4}, {"Fm", 1.60, 0xb31fba},
    {"Md", 1.60, 0xb30da6}, {"No", 1.60, 0xbd0d87}, {"Lr", 1.60, 0xc70066}, {"Rf", 1.60, 0xcc0059},
    {"Db", 1.60, 0xd1004f}, {"Sg", 1.60, 0xd90045}, {"Bh", 1.60, 0xe00038}, {"Hs", 1.60, 0xe6002e},
    {"Mt", 1.60, 0xeb0026}, {"Ds", 1.60, 0xeb0026}, {"Rg", 1.60, 0xeb0026}, {"Cn", 1.60, 0xeb0026},
    {"Nh", 1.60, 0xeb0026}, {"Fl", 1.60, 0xeb0026}, {"Mc", 1.60, 0xeb0026}, {"Lv", 1.60, 0xeb0026},
    {"Ts", 1.60, 0xeb0026}, {"Og", 1.60, 0xeb0026},
}};

glm::dvec3 colourOf(unsigned rgb) {
    return glm::dvec3((rgb >> 16U) & 255U, (rgb >> 8U) & 255U, rgb & 255U) / 255.0;
}

} // namespace

Element elementOf(int atomicNumber) noexcept {
    if (atomicNumber < 1 || atomicNumber > kHeaviestElement) return {"", 1.0, colourOf(0xff1493)};
    const Row& row = kElements[static_cast<std::size_t>(atomicNumber - 1)];
    return {row.symbol.data(), row.covalentRadius, colourOf(row.rgb)};
}

int atomicNumber(std::string_view symbol) noexcept {
    const auto* const found = std::find_if(kElements.begin(), kElements.end(),
                                           [&](const Row& row) { return row.symbol == symbol; });
    return found == kElements.end() ? 0 : static_cast<int>(found - kElements.begin()) + 1;
}

} // namespace voxsheet
