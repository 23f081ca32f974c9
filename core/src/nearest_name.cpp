#include "vicon/core/nearest_name.h"

#include <algorithm>
#include <utility>

namespace vicon {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row.back();
}

}  // namespace

std::string nearestName(const std::string& typed, const std::vector<std::string>& names, std::size_t most_letters)
{
    std::string nearest;
    std::size_t least = most_letters + 1;
    for (const std::string& name : names)
        if (const std::size_t letters = editDistance(name, typed); letters < least) {
            least = letters;
            nearest = name;
        }
    return nearest;
}

}  // namespace vicon
