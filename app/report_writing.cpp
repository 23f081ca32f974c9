#include "report_writing.h"

#include "peers.h"
#include "report_pictures.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/report/pdf_writer.h"
#include "vicon/report/report_objects.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

report::PdfResult drawReport(CaseStore& store, const Config& config, report::ReportContent& content,
                             const fs::path& pdf, Progress& progress)
{
    const PictureFolder pictures;
    content.scans = drawScans(store, content.read, pictures, progress);
    content.markers = drawMarkers(store, content.read, content.scans, pictures, progress);
    return report::writePdf(content, pdf, config.get<report::ReportOptions>());
}

}  // namespace

WrittenReport writeReport(CaseStore& store, const Config& config, const std::string& case_id, fs::path out,
                          Progress& progress)
{
    report::ReportContent content;
    content.read = readCase(store, case_id);
    const CaseRecord& record = content.read.record;
    requireReportable(store, record);
    content.created = nowUtc();
    content.software_version = VICON_VERSION;
    content.number = store.nextNumber("report " + record.id);
    if (out.empty())
        out = reportFile(store, record.id, content.number);
    const report::PdfResult written = drawReport(store, config, content, out, progress);
    store.audit("report written", record.id, "", "number " + std::to_string(content.number));
    return {out, content.number, written.pages, content.markers.size(), written.warnings};
}

namespace {

/// The signed version that an amendment takes the place of.
std::optional<ReportVersion> amendedBy(CaseStore& store, const std::string& case_id, const ReportVersion& version)
{
    for (const ReportVersion& earlier : reportVersions(store, case_id))
        if (version.replaces != 0 && earlier.version == version.replaces)
            return earlier;
    return std::nullopt;
}

/// The objects of what is signed, for the folder and for the outbox.
VersionObjects objectsOf(CaseStore& store, const Config& config, const std::string& case_id,
                         const report::ObjectContent& content, const fs::path& folder)
{
    const auto peers = config.get<SigningOptions>().send_to;
    for (const std::string& peer : peers)
        requirePeer(config, peer);
    const auto objects = report::writeReportObjects(store, content, folder);
    VersionObjects kept;
    for (const report::ReportObject& object : objects)
        kept.files.push_back(object.file);
    kept.also = [&store, case_id, peers, objects](soci::session& sql, const ReportVersion&) {
        std::vector<OutboxObject> queued;
        for (const report::ReportObject& object : objects)
            queued.push_back({reportFolder(store, case_id) / object.file.filename(), object.sop_class, object.sop_uid});
        for (const std::string& peer : peers)
            queueObjects(store, sql, case_id, peer, queued);
    };
    return kept;
}

}  // namespace

GivenReport giveOutReport(CaseStore& store, const Config& config, const std::string& case_id, bool sign,
                          Progress& progress)
{
    const CaseRecord record = store.requireCase(case_id);
    requireReportable(store, record);
    const VersionDraft draft = draftVersion(store, config.get<SigningOptions>(), record.id, sign, VICON_VERSION);
    report::ReportContent content;
    content.read = readCaseFromContent(draft.content);  // what is drawn is what is signed
    content.created = draft.version.at;
    content.software_version = VICON_VERSION;
    content.version = draft.version;
    const PictureFolder folder;
    const report::PdfResult drawn = drawReport(store, config, content, folder / "report.pdf", progress);
    if (drawn.unreadable_pictures > 0)
        throw Error(ErrorCode::store,
                    "a picture of the report could not be drawn (" + drawn.warnings.front() +
                        "); "
                        "nothing was signed",
                    record.id, "see whether the disk is full, then try again");
    progress.check();
    const std::string pdf = readFile(folder / "report.pdf");
    VersionObjects objects;
    if (sign) {
        const ReportVersion version = versionWith(store, record.id, draft, pdf);
        objects = objectsOf(store, config, record.id,
                            {content.read, version, amendedBy(store, record.id, version), pdf}, folder / "");
    }
    return {keepVersion(store, record.id, draft, pdf, objects), drawn.pages, drawn.warnings};
}

}  // namespace vicon::app
