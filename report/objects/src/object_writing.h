#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "vicon/report/report_objects.h"

namespace vicon::report {

/// When a version was given out, as DICOM writes it, in UTC.
struct DicomTime {
    std::string date, time;
};
DicomTime timeOf(const ReportVersion& version);

/// Of each kind a series of its own.
std::string seriesUid(const ReportVersion& version, ObjectKind kind);
int seriesNumber(ObjectKind kind);

/// Puts a text; an empty one leaves the element empty.
void put(DcmItem& item, const DcmTagKey& tag, const std::string& value);
/// Puts a code as the only item of a sequence.
void putCode(DcmItem& item, const DcmTagKey& tag, const char* value, const char* scheme, const char* meaning);

/// Patient, study, series, equipment and what is common to all objects. Overwrites what is there.
void putCommon(DcmDataset& dataset, const ObjectContent& content, ObjectKind kind, const char* modality,
               const char* description);

/// Writes it as `folder`/version-N-KIND.dcm. Throws Error{store}.
ReportObject save(DcmFileFormat& format, const ObjectContent& content, ObjectKind kind,
                  const std::filesystem::path& folder);

// One function for each kind.
ReportObject writeEncapsulatedPdf(const ObjectContent& content, const std::filesystem::path& folder);

}  // namespace vicon::report
