// The proofs in full; the ordinary tests hold samples of them.
#include "render_checks.h"
#include "scan_fixture.h"
#include "submarine_checks.h"

namespace vicon::viewer {
namespace {

struct LongFlights : test::ColonFixture {};
struct LongSubmarines : test::Submarines {};

TEST_F(LongFlights, AThousandCulledPicturesAreIdenticalToPicturesOfEverything)
{
    test::expectCulledPicturesIdentical(scan(), 1000, 2);
}

TEST_F(LongSubmarines, AMillionTicksNeverComeNearerToTheWallThanTheCamerasRadius)
{
    test::steerAtRandom(*this, 1000000);
}

}  // namespace
}  // namespace vicon::viewer
