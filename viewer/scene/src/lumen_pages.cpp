#include "lumen_pages.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace vicon::viewer {
namespace {

constexpr std::ptrdiff_t kPage = 4096 / sizeof(float);  // in voxels of a field

void lookAt(const float& voxel)
{
    static_cast<void>(*const_cast<const volatile float*>(&voxel));
}

/// For each page of the field, whether a camera in the lumen may look at it.
std::vector<char> pagesOfLumen(const FieldView& field, const InsideView& inside)
{
    const auto voxels = std::ptrdiff_t(field.voxels.size()), pages = (voxels + kPage - 1) / kPage;
    const std::ptrdiff_t slice = std::ptrdiff_t(field.grid.size[0]) * field.grid.size[1];
    const std::uint8_t* in = inside.voxels.data();
    std::vector<char> holds_lumen(std::size_t(pages), 0);
    tbb::parallel_for(tbb::blocked_range<std::ptrdiff_t>(0, pages), [&](const auto& range) {
        for (std::ptrdiff_t page = range.begin(); page < range.end(); ++page)
            holds_lumen[std::size_t(page)] = std::any_of(in + page * kPage, in + std::min((page + 1) * kPage, voxels),
                                                         [](std::uint8_t label) { return label != kOutside; });
    });
    // Between voxels a field is interpolated, so the pages beside count too.
    std::vector<char> wanted(std::size_t(pages), 0);
    for (std::ptrdiff_t page = 0; page < pages; ++page)
        if (holds_lumen[std::size_t(page)])
            for (const std::ptrdiff_t step : {std::ptrdiff_t(0), -kPage, kPage, -slice, slice})
                for (const std::ptrdiff_t at : {page * kPage + step, (page + 1) * kPage - 1 + step})
                    if (at >= 0 && at < voxels)
                        wanted[std::size_t(at / kPage)] = 1;
    return wanted;
}

/// Runs of wanted pages at once, small gaps included: a disk reads a whole run as fast as its parts.
void askFor(const std::vector<char>& wanted, const scan_files::StoredVolume<float>& field)
{
    constexpr std::size_t kGap = 16;
    for (std::size_t page = 0; page < wanted.size(); ++page) {
        if (!wanted[page])
            continue;
        std::size_t last = page;
        for (std::size_t next = page; next < wanted.size() && next <= last + kGap; ++next)
            if (wanted[next])
                last = next;
        field.readAhead(page * std::size_t(kPage), (last + 1) * std::size_t(kPage));
        page = last;
    }
}

}  // namespace

void bringInLumen(const scan_files::StoredVolume<float>& stored, const InsideView& inside, const Progress* progress)
{
    const FieldView& field = stored.view();
    if (field.grid != inside.grid)
        return;
    const std::vector<char> wanted = pagesOfLumen(field, inside);
    askFor(wanted, stored);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, wanted.size()), [&](const auto& pages) {
        for (std::size_t page = pages.begin(); page < pages.end(); ++page) {
            if (progress)
                progress->check();
            for (const std::size_t at : {page * std::size_t(kPage), (page + 1) * std::size_t(kPage) - 1})
                if (wanted[page] && at < field.voxels.size())
                    lookAt(field.voxels[at]);
        }
    });
}

}  // namespace vicon::viewer
