#include "vicon/cases/store_presence.h"

#include "vicon/core/error.h"

namespace vicon {

void requireThere(const StorePlace& place)
{
    if (!place.holdsStore() && !place.holdsData())
        throw Error(ErrorCode::store, "the store is gone", place.folder.string(), "see whether its disk is mounted");
}

CaseStore openAgain(const StorePlace& place)
{
    requireThere(place);
    return CaseStore(place);
}

}  // namespace vicon
