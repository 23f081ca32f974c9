#include "vicon/viewer/scene/prepared_scan.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "scan_fixture.h"

namespace vicon::viewer {
namespace {

struct PreparedScans : test::ColonFixture {};

/// How often the calling thread has met a page that it could not see yet.
long pageFaults()
{
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt + usage.ru_majflt;
}

double sumOverLumen(const FieldView& field, const InsideView& inside)
{
    double sum = 0;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n] != kOutside)
            sum += field.voxels[n];
    return sum;
}

// The camera flies on the window's thread, which must not wait for a disk.
TEST_F(PreparedScans, ThatAreReadForAFlightHaveTheFieldsOfTheLumenInMemory)
{
    const PreparedScan prepared = scan();
    prepared.readForFlight();
    const InsideView inside = prepared.inside();
    const FieldView wall = prepared.wallDistance(), exit = prepared.exitDistance();
    sumOverLumen(FieldView(inside.grid, std::vector<float>(inside.voxels.size())), inside);  // the code and the labels
    const long before = pageFaults();
    const double sum = sumOverLumen(wall, inside) + sumOverLumen(exit, inside);
    EXPECT_EQ(pageFaults(), before);
    EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace vicon::viewer
