#pragma once

#include "vicon/cases/case_store.h"

namespace vicon {

/// How much of a case's id a person must type.
enum class IdPart {
    beginning,  ///< to look at a case
    whole,      ///< to change, delete, sign or send it: a slip must not hit another patient's
};

/// The case of that id, or the only one whose id begins so where that is enough. Throws Error{not_found}, and
/// Error{wrong_use} where the whole id is needed.
CaseRecord requireCase(CaseStore& store, const std::string& case_id, IdPart enough);

}  // namespace vicon
