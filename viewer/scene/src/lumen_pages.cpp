#include "lumen_pages.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace vicon::viewer {
namespace {

constexpr std::ptrdiff_t kPage = 4096 / sizeof(float);  // in voxels of a field

void lookAt(const float& voxel)
{
    static_cast<void>(*const_cast<const volatile float*>(&voxel));
}

}  // namespace

void bringInLumen(const FieldView& field, const InsideView& inside)
{
    if (field.grid != inside.grid)
        return;
    const auto voxels = std::ptrdiff_t(field.voxels.size());
    const std::ptrdiff_t slice = std::ptrdiff_t(field.grid.size[0]) * field.grid.size[1];
    // Between voxels a field is interpolated, so the pages beside count too.
    const std::array<std::ptrdiff_t, 5> around{0, -kPage, kPage, -slice, slice};
    const std::uint8_t* in = inside.voxels.data();
    tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, (voxels + kPage - 1) / kPage), [&](const auto& pages) {
        for (std::ptrdiff_t page = pages.begin(); page < pages.end(); ++page) {
            const std::ptrdiff_t first = page * kPage, end = std::min(first + kPage, voxels);
            if (std::all_of(in + first, in + end, [](std::uint8_t label) { return label == kOutside; }))
                continue;
            for (const std::ptrdiff_t step : around)
                for (const std::ptrdiff_t at : {first + step, end - 1 + step})
                    if (at >= 0 && at < voxels)
                        lookAt(field.voxels[std::size_t(at)]);
        }
    });
}

}  // namespace vicon::viewer
