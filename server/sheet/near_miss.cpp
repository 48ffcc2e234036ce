#include "sheet/near_miss.h"

#include "sheet/utf8.h"

#include <algorithm>
#include <cstddef>

namespace voxsheet::sheet {

int editDistance(std::string_view first, std::string_view second) {
    // A longer word is no near miss of a name, and the table must stay small for hostile input.
    constexpr std::size_t longest = 80;
    const std::string a = lowerAscii(first.substr(0, longest));
    const std::string b = lowerAscii(second.substr(0, longest));
    std::vector<int> beforeLast(b.size() + 1);
    std::vector<int> last(b.size() + 1);
    std::vector<int> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({substitution, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        std::swap(beforeLast, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string nearestName(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    int bestDistance = 1 << 20;
    for (const std::string& candidate : candidates) {
        const std::string tail = candidate.substr(candidate.rfind('.') + 1);
        int distance = editDistance(word, candidate);
        if (tail != candidate && !word.empty() && lowerAscii(word) == lowerAscii(tail)) distance = 1;
        if (distance <= std::max<int>(1, static_cast<int>(candidate.size()) / 3) && distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

} // namespace voxsheet::sheet
