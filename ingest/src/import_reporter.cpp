#include "import_reporter.h"

#include <algorithm>

#include "vicon/core/printable.h"

namespace vicon::ingest {

void Reporter::object(ImportLine::Kind kind, const std::string& shown, const std::string& series_uid,
                      const std::string& why, const std::string& case_id)
{
    ++(kind == ImportLine::Kind::set_aside ? report_.set_aside : report_.refused);
    if (!series_uid.empty()) {
        const auto [same, is_new] = line_of_.try_emplace({series_uid, kind, why}, lines_.size());
        if (!is_new) {
            ++lines_[same->second].count;
            return;
        }
    }
    lines_.push_back({{kind, shown, why, case_id, {}}, 1, series_uid});
}

void Reporter::finish()
{
    for (Counted& counted : lines_) {
        if (counted.count > 1) {
            counted.line.subject = counted.series_uid;
            counted.line.text += " (" + std::to_string(counted.count) + " files)";
        }
        counted.line.subject = printable(counted.line.subject);
        counted.line.text = printable(counted.line.text);
        report_.lines.push_back(std::move(counted.line));
    }
    lines_.clear();
    line_of_.clear();
}

nlohmann::json noteOf(const std::string& object, const std::string& why)
{
    return {{"object", object}, {"why", why}};
}

void addNote(nlohmann::json& list, nlohmann::json note)
{
    constexpr std::size_t kMostNotes = 200;
    if (list.size() > kMostNotes || std::find(list.begin(), list.end(), note) != list.end())
        return;
    if (list.size() == kMostNotes)
        note = noteOf("...", "and more than these " + std::to_string(kMostNotes) + " objects");
    list.push_back(std::move(note));
}

}  // namespace vicon::ingest
