#pragma once

#include "vicon/cases/records.h"

namespace vicon::ingest {

/// Whether name and birth date of two patients do not contradict each other. What one of them does not say is no
/// contradiction; neither is upper and lower case, or how the parts of a name are delimited.
bool sameNameAndBirth(const Patient& a, const Patient& b);

/// Whether two patients are the same: same ID, and no contradiction otherwise.
bool samePatient(const Patient& a, const Patient& b);

/// Whether objects of one study are of two patients: ID, name or birth date contradict each other.
bool contradict(const Patient& a, const Patient& b);

/// Takes what is not known of a patient from what an object of the same study says.
void addWhatIsNotKnown(Patient& known, const Patient& said);

}  // namespace vicon::ingest
