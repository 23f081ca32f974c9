#pragma once

namespace vicon {

/// What the audit trail keeps of a case that is deleted, so that messages about it name whose it was.
inline constexpr const char *kPatientIdKey = "patient_id", *kStudyUidKey = "study_uid";

}  // namespace vicon
