#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/assessment.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/cases/records.h"

namespace vicon {

// A report of the same patient, as it was read back: VICON's own, or any maker's that holds measurements of TID 1500.
// What it does not say is empty. Texts are UTF-8.

/// A number that VICON has no place for, in the report's own words.
struct PriorMeasure {
    std::string name;
    double value = 0;
    std::string unit;
};

/// A finding as one scan showed it then.
struct PriorSight {
    std::string marker;      ///< what it was called there
    std::string series_uid;  ///< of the image that shows it
    std::string image_uid;
    std::string frame_of_reference_uid;
    std::optional<Point3> position_mm;  ///< in that frame, which is no other scan's
    std::optional<ColonPart> part;
    std::string site;  ///< in the report's words
    std::optional<double> station_mm, from_caecum_mm;
    std::optional<double> fraction;       ///< of the colon's length, from the anus
    std::optional<double> part_fraction;  ///< of its part's length, from the part's anal end
    std::optional<int> clock_hour;
    std::optional<double> size_2d_mm, size_3d_mm;
    std::optional<double> size_least_mm, size_most_mm;      ///< of an outlined one: eight in ten lie between them
    std::optional<double> height_mm, volume_ml;             ///< as it was outlined
    std::optional<double> volume_least_ml, volume_most_ml;  ///< eight in ten lie between them
    std::optional<double> mean_hu;
};

struct PriorFinding {
    std::string uid;   ///< tracking UID; where it has none one that follows from report and place in it
    std::string name;  ///< "Finding 3"
    std::string what;  ///< in the report's words
    std::optional<FindingKind> kind;
    std::optional<Morphology> morphology;
    std::optional<Attenuation> attenuation;
    std::optional<Confidence> confidence;
    std::optional<double> size_mm;  ///< the one that counted
    std::string size_from;          ///< "best plane", "reader", or in the report's words
    std::optional<double> height_mm, volume_ml;
    std::optional<EndoscopeDistance> endoscope;
    bool narrows_lumen = false, invades = false;
    std::string note;
    std::vector<PriorSight> sights;
    std::size_t leading = 0;  ///< of the sights, the one that says where it lies
    std::vector<PriorMeasure> others;

    const PriorSight* lead() const { return leading < sights.size() ? &sights[leading] : nullptr; }
};

struct PriorScan {
    std::string series_uid;
    std::string position;  ///< "supine", ...
    std::string kernel;
    double slice_thickness_mm = 0;  ///< 0: not said
};

struct PriorPart {
    std::string series_uid;
    ColonPart part = ColonPart::rectum;
    Distension distension = Distension::good;
};

struct PriorReport {
    std::string sop_uid, sop_class, series_uid;  ///< of the structured report
    std::string case_id;                         ///< in this store; empty: it came as an object alone
    Patient patient;
    Study study;
    std::string maker, person;
    std::string date;  ///< YYYYMMDD, when it was written
    bool is_signed = false;
    std::vector<std::string> replaces;  ///< SOP Instance UIDs of its earlier versions
    std::vector<PriorScan> scans;       ///< those that it says something of
    std::vector<PriorFinding> findings;
    std::vector<PriorPart> parts;
    Assessment said;
    std::vector<std::string> not_read;  ///< what could not be read of it, a line each

    /// When the patient was examined, else when it was written; YYYYMMDD.
    const std::string& when() const { return study.date.empty() ? date : study.date; }
    const PriorFinding* finding(const std::string& uid) const;
    const PriorScan* scan(const std::string& series_uid) const;
};

/// The earlier reports of a case's patient, and what cannot be shown of them.
struct PriorList {
    std::vector<PriorReport> reports;   ///< the last one first; none that another one replaced
    std::vector<std::string> left_out;  ///< why, a line each
};

nlohmann::json toJson(const PriorFinding& finding);
nlohmann::json toJson(const PriorReport& report);

/// "2024-05-01, VICON: 2 findings, C2a"; without the patient's name.
std::string inBrief(const PriorReport& report);
/// "2024: polyp 6.1 mm", for pictures.
std::string labelOf(const PriorReport& report, const PriorFinding& finding);

}  // namespace vicon
