#include "stand_in_uid.h"

#include "vicon/core/file.h"
#include "vicon/core/uid.h"

namespace vicon::ingest {

namespace {

/// DICOM PS3.5 section 9.1, but for zeros in front of a component, which do no harm.
bool isUidButForZeros(const std::string& text)
{
    constexpr std::size_t kLongestUid = 64;
    return text.size() <= kLongestUid && text.find_first_not_of("0123456789.") == std::string::npos;
}

}  // namespace

void fillStandInUids(ImageObject& object)
{
    const Study& study = object.study;
    const std::string study_key = object.patient.id + '\n' + object.patient.name + '\n' + object.patient.birth_date +
                                  '\n' + study.date + '\n' + study.time + '\n' + study.id + '\n' +
                                  study.accession_number + '\n' +
                                  (study.id.empty() ? object.series.frame_of_reference_uid : "");
    if (study.uid.empty()) {
        object.study.uid = uidFor("study\n" + study_key);
        object.repairs.emplace_back("Study Instance UID missing: grouped by patient, date and frame of reference");
    }
    if (object.series.uid.empty()) {
        const Series& series = object.series;
        object.series.uid =
            uidFor("series\n" + object.study.uid + '\n' + std::to_string(series.number) + '\n' + series.description +
                   '\n' + series.kernel + '\n' + series.patient_position + '\n' + series.frame_of_reference_uid);
        object.repairs.emplace_back("Series Instance UID missing: grouped by number, description and kernel");
    }
    if (!isUidButForZeros(object.study.uid))  // by which others ask for the study
        object.repairs.push_back("Study Instance UID is no UID: " + object.study.uid);
    if (!isUidButForZeros(object.series.uid)) {
        object.repairs.push_back("Series Instance UID is no UID: another stands for " + object.series.uid);
        object.series.uid = uidFor("series\n" + object.study.uid + '\n' + object.series.uid);
    }
    if (object.sop_uid.empty()) {
        object.sop_uid = uidFor("object\n" + sha256OfFile(object.file));
        object.repairs.emplace_back("SOP Instance UID missing: derived from the file's content");
    }
}

}  // namespace vicon::ingest
