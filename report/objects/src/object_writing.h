#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "source_images.h"
#include "vicon/report/report_objects.h"

namespace vicon::report {

/// When a version was given out, as DICOM writes it, in UTC.
/// By this machine's clock on the wall, as scanners give the times of the study beside it: a Timezone Offset From UTC
/// would be said of those too.
struct DicomTime {
    std::string date, time;
};
/// Nothing of a version that says no time.
DicomTime timeOf(const ReportVersion& version);

/// Of each kind a series of its own.
std::string seriesUid(const ReportVersion& version, ObjectKind kind);
int seriesNumber(ObjectKind kind);

/// A decimal string of DICOM: the most digits that its 16 characters hold.
std::string decimalString(double value);

/// Of a lumen that VICON did not make: its algorithm's name, at most 64 characters, and whence it came.
inline constexpr const char* kOtherAlgorithm = "Another program's, not known to VICON";
inline std::string otherLumenWords(const LumenOrigin& origin)
{
    return "Made by another program: " + textOf(origin);
}

/// Puts a text; an empty one leaves the element empty.
void put(DcmItem& item, const DcmTagKey& tag, const std::string& value);
/// Puts a code as the only item of a sequence.
void putCode(DcmItem& item, const DcmTagKey& tag, const char* value, const char* scheme, const char* meaning);

/// What an object is, among those of its report.
struct ObjectName {
    ObjectKind kind = ObjectKind::pdf;
    const char* modality = "";
    std::string series = {};  ///< the description of its series
    std::string which = {};   ///< of several of this kind
    int number = 0;           ///< within its series; 0: the version's
};

/// Patient, study, series, equipment and what is common to all objects. Overwrites what is there.
void putCommon(DcmDataset& dataset, const ObjectContent& content, const ObjectName& name);

/// Writes it as `folder`/version-N-KIND.dcm, or version-N-KIND-WHICH.dcm. Throws Error{store}.
ReportObject save(DcmFileFormat& format, const ObjectContent& content, const ObjectName& name,
                  const std::filesystem::path& folder, E_TransferSyntax syntax = EXS_LittleEndianExplicit);

// One function for each kind.
ReportObject writeEncapsulatedPdf(const ObjectContent& content, const std::filesystem::path& folder);
/// @param number within the series, from 1
/// @param source the image of the study in which what it shows lies; may be none
ReportObject writePictures(const ObjectContent& content, const SightPictures& pictures, int number,
                           const SourceImage* source, const std::filesystem::path& folder);
/// The lumen of a scan, as drawLumen() made it.
ReportObject writeLumen(const ObjectContent& content, const std::string& scan_id, DcmFileFormat& lumen,
                        const std::filesystem::path& folder);

}  // namespace vicon::report
