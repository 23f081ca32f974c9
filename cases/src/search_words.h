#pragma once

#include <soci/soci.h>

#include <functional>
#include <string>
#include <vector>

#include "vicon/cases/records.h"

namespace vicon {

/// What a case is found by, in lower case: parts of the patient's name, the patient's ID, accession number, study date
/// and the case's own id.
std::vector<std::string> searchWords(const CaseRecord& a_case);

/// The words of what a reader typed, or a case says: the first hundred.
std::vector<std::string> wordsIn(const std::string& text);

/// The word that the fewest cases have, or one that at least `most` have where all are so frequent. Counting stops soon
/// where one is rare.
/// @param count how many words of cases begin so, up to a limit
std::string rarestOf(const std::vector<std::string>& words, int most,
                     const std::function<int(const std::string& beginning, int limit)>& count);

/// Keeps a case's words, within a transaction of the caller.
void putSearchWords(soci::session& sql, const CaseRecord& a_case);

/// A text after all that begin with `beginning`, in the order of bytes.
std::string endOf(const std::string& beginning);

}  // namespace vicon
