#include "vicon/cases/whole_id.h"

#include "vicon/core/error.h"

namespace vicon {

CaseRecord requireCase(CaseStore& store, const std::string& case_id, IdPart enough)
{
    CaseRecord found = store.requireCase(case_id);
    if (enough == IdPart::whole && found.id != case_id)
        throw Error(ErrorCode::wrong_use, "the beginning of an id is not enough to change or send a case",
                    "'" + case_id + "'", "type all of it: " + found.id);
    return found;
}

}  // namespace vicon
