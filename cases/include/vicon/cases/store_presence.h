#pragma once

#include "vicon/cases/case_store.h"

namespace vicon {

/// For whoever goes on with a store that was there: throws Error{store} where it is gone, because its disk is not
/// mounted or it was moved. Nothing is made in its place.
void requireThere(const StorePlace& place);

/// Opens a store that is there. Throws as requireThere() and the store's constructor.
CaseStore openAgain(const StorePlace& place);

}  // namespace vicon
