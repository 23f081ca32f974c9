// Both studies read from worklist to signature on three screens, from inside first and in slices first, by keyboard
// alone and by mouse alone. The pictures are there to be looked at; what is held here is that every step can be done,
// that every view has room and that nothing reaches beyond the screen.
#include "whole_reading.h"

namespace vicon::viewer::test {
namespace {

std::vector<WalkOf> allWalks()
{
    std::vector<WalkOf> walks;
    for (const QSize screen : {QSize(1366, 738), QSize(1920, 1050), QSize(2560, 1410)})  // less a window's title
        for (const bool phantom : {false, true})
            for (const bool slices_first : {false, true})
                walks.push_back({phantom, screen, slices_first});
    return walks;
}

std::string nameOfWalk(const testing::TestParamInfo<WalkOf>& walk)
{
    return std::string(walk.param.phantom ? "Phantom" : "Scan") + "At" + std::to_string(walk.param.screen.width()) +
           (walk.param.slices_first ? "SlicesFirst" : "InsideFirst");
}

TEST_P(ByKeyboard, AStudyIsReadFromWorklistToSignature)
{
    readAll();
}

TEST_P(ByMouse, AStudyIsReadFromWorklistToSignature)
{
    readAll();
}

INSTANTIATE_TEST_SUITE_P(All, ByKeyboard, testing::ValuesIn(allWalks()), nameOfWalk);
INSTANTIATE_TEST_SUITE_P(All, ByMouse, testing::ValuesIn(allWalks()), nameOfWalk);

}  // namespace
}  // namespace vicon::viewer::test
