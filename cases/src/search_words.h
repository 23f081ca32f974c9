#pragma once

#include <soci/soci.h>

#include <string>
#include <vector>

#include "vicon/cases/records.h"

namespace vicon {

/// What a case is found by, in lower case: parts of the patient's name, the patient's ID, accession number, study date
/// and the case's own id.
std::vector<std::string> searchWords(const CaseRecord& a_case);

/// The words of what a reader typed.
std::vector<std::string> wordsIn(const std::string& text);

/// Keeps a case's words, within a transaction of the caller.
void putSearchWords(soci::session& sql, const CaseRecord& a_case);

/// A text after all that begin with `beginning`, in the order of bytes.
std::string endOf(const std::string& beginning);

}  // namespace vicon
