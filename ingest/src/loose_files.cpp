#include "loose_files.h"

#include "kept_name.h"

namespace fs = std::filesystem;

namespace vicon::ingest {

std::vector<fs::path> LooseFiles::of(const std::string& sop_uid)
{
    if (!looked_)
        look();
    const auto [begin, end] = files_.equal_range(keptNameOf(sop_uid));
    std::vector<fs::path> found;
    for (auto one = begin; one != end; ++one)
        found.push_back(one->second);
    return found;
}

void LooseFiles::look()
{
    looked_ = true;
    for (const char* where : {"incoming", "quarantine"}) {
        std::error_code trouble;  // the import may move what is being looked at
        for (fs::recursive_directory_iterator entry(store_ / where, trouble), end; !trouble && entry != end;
             entry.increment(trouble))
            if (std::string name = keptNameIn(entry->path().filename().string()); !name.empty())
                files_.emplace(std::move(name), entry->path());
    }
}

}  // namespace vicon::ingest
