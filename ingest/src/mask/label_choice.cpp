#include "mask/label_choice.h"

#include "mask/refusal.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kMostListed = 12;

std::string listOf(const std::map<std::int64_t, std::string>& labels)
{
    std::string list;
    std::size_t listed = 0;
    for (const auto& [label, name] : labels) {
        if (listed++ == kMostListed)
            return list + " and " + std::to_string(labels.size() - kMostListed) + " more";
        list += (list.empty() ? "" : ", ") + std::to_string(label) + (name.empty() ? "" : " '" + shown(name) + "'");
    }
    return list;
}

}  // namespace

std::int64_t chooseLabel(const std::map<std::int64_t, std::string>& labels, std::optional<int> asked,
                         const std::filesystem::path& file)
{
    if (labels.empty())
        throw maskRefused(file, "is empty: no voxel of it is marked", "look at it in the program that wrote it");
    if (asked && labels.contains(*asked))
        return *asked;
    if (asked)
        throw Error(ErrorCode::wrong_use, "has no label " + std::to_string(*asked) + "; it has " + listOf(labels),
                    file.string(), "name one of these with --label");
    if (labels.size() > 1)
        throw Error(ErrorCode::wrong_use, "has several labels: " + listOf(labels), file.string(),
                    "name the lumen's with --label");
    return labels.begin()->first;
}

}  // namespace vicon::ingest
