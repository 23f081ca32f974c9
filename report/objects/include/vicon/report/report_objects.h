#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"

namespace vicon::report {

/// The forms that a report takes in a PACS.
enum class ObjectKind {
    pdf,           ///< Encapsulated PDF
    measurements,  ///< Comprehensive 3D SR, TID 1500
    key_images,    ///< Key Object Selection of the slices that show findings
};
/// "pdf", "sr", "key".
std::string nameOf(ObjectKind kind);

/// The SOP Instance UID of a version's object. It follows from the version's digest: the same report makes the same
/// objects.
std::string objectUid(const ReportVersion& version, ObjectKind kind);

struct ReportObject {
    ObjectKind kind = ObjectKind::pdf;
    std::string sop_class, sop_uid;
    std::filesystem::path file;
};

/// What objects are made of.
struct ObjectContent {
    const ReadCase& read;
    const ReportVersion& version;
    std::optional<ReportVersion> amended;  ///< the version that this one takes the place of
    std::string_view pdf;
};

/// Writes a report's objects into a folder, as version-N-KIND.dcm; each is a series of its own in the study that the
/// report is about. Without findings in source images there are no key images. Dates are UTC and say so; texts are
/// UTF-8. Throws Error{store}.
std::vector<ReportObject> writeReportObjects(CaseStore& store, const ObjectContent& content,
                                             const std::filesystem::path& folder);

}  // namespace vicon::report
