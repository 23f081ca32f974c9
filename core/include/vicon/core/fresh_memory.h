#pragma once

#include <cstddef>
#include <vector>

namespace vicon {

/// Has the system bring the pages of new memory in on several cores: where one core does it, page by page as they are
/// first used, large arrays cost more than what is then done with them. What the memory holds is lost.
void touchPages(void* begin, std::size_t bytes);

/// Makes the values `count` times `fill`, in memory that is brought in by touchPages(). Throws std::bad_alloc and
/// std::length_error.
template <class T>
void fillFresh(std::vector<T>& values, std::size_t count, T fill)
{
    values = {};
    values.reserve(count);
    touchPages(values.data(), count * sizeof(T));
    values.assign(count, fill);
}

}  // namespace vicon
