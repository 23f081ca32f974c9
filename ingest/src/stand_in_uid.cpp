#include "stand_in_uid.h"

#include <algorithm>

#include "vicon/core/file.h"

namespace vicon::ingest {

std::string standInUid(const std::string& text)
{
    // A UUID of version 8 (made by the application) in decimal digits, as PS3.5 B.2 writes them.
    std::string hex = sha256(text).substr(0, 32);
    hex[12] = '8';
    hex[16] = "89ab"[std::stoi(hex.substr(16, 1), nullptr, 16) % 4];
    __uint128_t value = 0;
    for (const char digit : hex)
        value = value * 16 + unsigned(std::stoi(std::string(1, digit), nullptr, 16));
    std::string decimal;
    for (; value > 0; value /= 10)
        decimal += char('0' + int(value % 10));
    std::reverse(decimal.begin(), decimal.end());
    return "2.25." + decimal;
}

void fillStandInUids(ImageObject& object)
{
    const Study& study = object.study;
    const std::string study_key = object.patient.id + '\n' + object.patient.name + '\n' + object.patient.birth_date +
                                  '\n' + study.date + '\n' + study.time + '\n' + study.id + '\n' +
                                  study.accession_number + '\n' +
                                  (study.id.empty() ? object.series.frame_of_reference_uid : "");
    if (study.uid.empty()) {
        object.study.uid = standInUid("study\n" + study_key);
        object.repairs.emplace_back("Study Instance UID missing: grouped by patient, date and frame of reference");
    }
    if (object.series.uid.empty()) {
        const Series& series = object.series;
        object.series.uid = standInUid("series\n" + object.study.uid + '\n' + std::to_string(series.number) + '\n' +
                                       series.description + '\n' + series.kernel + '\n' + series.patient_position +
                                       '\n' + series.frame_of_reference_uid);
        object.repairs.emplace_back("Series Instance UID missing: grouped by number, description and kernel");
    }
    if (object.sop_uid.empty()) {
        object.sop_uid = standInUid("object\n" + sha256OfFile(object.file));
        object.repairs.emplace_back("SOP Instance UID missing: derived from the file's content");
    }
}

}  // namespace vicon::ingest
