#include "vicon/core/progress.h"

#include "vicon/core/error.h"

namespace vicon {

void Progress::check() const
{
    if (cancelled())
        throw Error(ErrorCode::cancelled, "cancelled");
}

}  // namespace vicon
