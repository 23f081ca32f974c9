#pragma once

#include <string>
#include <string_view>

#include "vicon/core/geometry.h"

namespace vicon::report {

/// "20261121" and "081530.25" become "2026-11-21, 08:15"; without a time only the date.
std::string dateTimeWords(std::string_view dicom_date, std::string_view dicom_time);

/// "2026-11-21T08:15:30Z" becomes "2026-11-21 08:15 UTC"; what is no such time is returned as it is.
std::string utcWords(std::string_view utc);

/// "M" becomes "male", "F" "female", "O" "other"; anything else is returned as it is.
std::string sexWords(std::string_view dicom_sex);

/// "HFP" becomes "prone, head first"; empty becomes "position not given".
std::string patientPositionWords(const std::string& patient_position);

/// "L 85.2, P 12.0, H 340.5 mm": towards the patient's left or right (L, R), back or front (P, A), head or feet (H, F),
/// from the origin of the scan's coordinates.
std::string positionLetters(Point3 position_mm);
/// What the letters mean: "left, posterior, headward of the scan's origin".
std::string positionWords(Point3 position_mm);

/// "412 mm".
std::string millimetres(double length_mm, int decimals = 0);
/// "25.8 %" of 0.258.
std::string percent(double fraction, int decimals = 1);

/// What an endoscope might show at a place of the colon, as an estimate: the distance along the centreline from the
/// rectal end times the published factor of its part (caecum 0.57, right colon 0.59, left colon 0.78). Between the two
/// flexures, and where the part is not known, both factors give a range. For example "about 32 cm (0.78 × CT distance,
/// left colon)".
std::string endoscopeEstimate(double station_mm, std::string_view part_name);

/// What a reader must know about the distances: how they were measured, and the factors of the estimate.
std::string distancesExplained();

}  // namespace vicon::report
