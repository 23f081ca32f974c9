#include "store_copying.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// What of a store cannot be made again, and the results.
constexpr const char* kFolders[] = {"cases", "reports", "quarantine", "incoming", "watch", "commitments"};
/// By which a patient gets the same pseudonym again.
constexpr const char* kFiles[] = {"anonymous.key"};

}  // namespace

StoreCopying::StoreCopying(const fs::path& from, const fs::path& to, RecordedHashes* recorded, Progress& progress)
    : from_(from), to_(to), recorded_(recorded), progress_(progress)
{
}

void StoreCopying::keep(const std::vector<FileFault>& missing)
{
    kept_.clear();
    for (const FileFault& fault : missing)
        for (fs::path place = to_ / fault.file; place != to_; place = place.parent_path())
            kept_.insert(place);
}

MirrorCalls StoreCopying::calls()
{
    if (!recorded_)
        return {};
    recorded_->forget();  // others write to the store between two rounds
    return {.sha256_of = [this](const fs::path& copy) { return recorded_->of(copy.lexically_relative(to_)); },
            .changed =
                [this](const fs::path& copy, bool is_good) {
                    const fs::path file = copy.lexically_relative(to_);
                    changed_[file] = {caseOf(file).value_or(""), file,
                                      is_good ? FileFault::Kind::changed_kept : FileFault::Kind::changed};
                }};
}

void StoreCopying::copyAll(const std::string& name)
{
    progress_.report(0, name);
    counts_.files = 0;
    changed_.clear();
    MirrorCalls calls = this->calls();
    calls.seen = [&](const fs::path&) { ++counts_.files; };
    for (const char* folder : kFolders)
        mirror(from_ / folder, to_ / folder, kept_, counts_, progress_, calls);
    for (const char* file : kFiles)
        if (fs::exists(from_ / file)) {
            mirrorFile(from_ / file, to_ / file, counts_);
            ++counts_.files;
        }
}

void StoreCopying::copyCases(const std::set<std::string>& cases)
{
    for (const std::string& case_id : cases) {
        progress_.report(0, "copying case " + case_id);
        std::erase_if(changed_, [&](const auto& one) { return one.second.case_id == case_id; });
        const fs::path folder = fs::path("cases") / case_id;
        mirror(from_ / folder, to_ / folder, kept_, counts_, progress_, calls());
    }
}

std::vector<FileFault> StoreCopying::changed() const
{
    std::vector<FileFault> faults;
    for (const auto& [file, fault] : changed_)
        faults.push_back(fault);
    return faults;
}

}  // namespace vicon
