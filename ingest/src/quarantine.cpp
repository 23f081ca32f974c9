#include "quarantine.h"

#include <map>
#include <set>

#include "kept_name.h"
#include "stored_files.h"
#include "text.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {

void quarantine(const ImportContext& context, const CaseRecord& of_case, const std::vector<ImageObject>& strangers)
{
    std::map<std::string, std::vector<FileCopy>> folders;
    for (const ImageObject& object : strangers) {
        const Patient& p = object.patient;
        const std::string who = sha256(p.id + '\n' + foldedForComparison(p.name) + '\n' + p.birth_date).substr(0, 10);
        const std::string name = keptNameOf(object.sop_uid) + "-" + object.sha256.substr(0, 32) + ".dcm";
        folders[of_case.id + "/" + who].push_back({object.file, name});
    }
    for (auto& [folder, copies] : folders) {
        const fs::path target = context.store.folder() / "quarantine" / folder;
        const std::string text =
            " objects of this study name another patient than its case; they lie in quarantine/" + folder;
        context.reporter.line(
            {ImportLine::Kind::quarantined, of_case.study.uid, std::to_string(copies.size()) + text, of_case.id, {}});
        context.report.refused += int(copies.size());
        std::set<std::string> names;
        std::erase_if(copies, [&](const FileCopy& copy) {
            return fs::exists(target / copy.name) || !names.insert(copy.name).second;
        });
        if (copies.empty())
            continue;
        copyDurably(target, copies, context.progress);
        context.store.audit(AuditEvent::quarantined, of_case.id, "", folder);
    }
}

}  // namespace vicon::ingest
