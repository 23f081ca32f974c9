#include "report_import.h"

#include "same_object.h"
#include "stored_files.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/structured_report.h"

namespace vicon::ingest {
namespace {

using Kind = ImportLine::Kind;

/// DICOM's "Imaging Measurement Report", the root of TID 1500.
constexpr const char* kMeasurementReport = "126000";

std::string inWords(const ContentDocument& document)
{
    std::string words = "measurement report";
    if (!document.maker.empty())
        words += " by " + document.maker;
    words += document.study.date.empty() ? ", of an undated study" : ", of a study of " + document.study.date;
    std::string not_read;
    for (const std::string& line : document.not_read)
        not_read += (not_read.empty() ? "; not read: " : ", ") + line;
    return words + not_read;
}

/// Whether the file of a kept report is gone, or no longer what was stored. Throws Error where it cannot be read.
bool isLost(const KeptReport& known, const ImportContext& context)
{
    const std::filesystem::path file = keptReportsFolder(context.store) / known.file;
    return !std::filesystem::exists(file) || sha256OfFile(file) != known.sha256;
}

void store(const ImageObject& object, const ContentDocument& document, const ImportContext& context)
{
    const KeptReport kept{document.sop_uid, document.sop_class,        document.series_uid,           document.patient,
                          document.study,   sha256OfFile(object.file), fileNameFor(document.sop_uid), nowUtc()};
    copyDurably(keptReportsFolder(context.store), {{object.file, kept.file}}, context.progress);
    keepReport(context.store, kept);
    context.reporter.line({Kind::stored, document.series_uid, inWords(document), {}, {}});
}

}  // namespace

void takeReport(const ImageObject& object, const std::string& shown, bool unpacked, const ImportContext& context)
{
    const auto leave = [&](Kind kind, const std::string& why) {
        if (!unpacked)
            context.report.not_stored.push_back(object.file);
        context.reporter.object(kind, shown, object.series.uid, why);
    };
    try {
        const ContentDocument document = readStructuredReport(object.file);
        if (document.root.name.value != kMeasurementReport)
            return leave(Kind::set_aside, "structured report, no measurement report");
        const auto known = findKeptReport(context.store, document.sop_uid);
        const bool lost = known && isLost(*known, context);
        if (known && !lost && !isSameObject(object.file, keptReportsFolder(context.store) / known->file))
            return leave(Kind::refused, "the same SOP Instance UID with other content is stored; the first is kept");
        if (known && !lost)
            context.reporter.line({Kind::unchanged, document.series_uid, inWords(document), {}, {}});
        else
            store(object, document, context);
        ++context.report.reports;
    } catch (const Error& e) {
        if (e.code() != ErrorCode::bad_input)
            throw;
        leave(Kind::refused, e.what());
    }
}

}  // namespace vicon::ingest
