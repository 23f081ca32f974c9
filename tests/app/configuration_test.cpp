// Where values of options come from, and who may say what.
#include "configuration.h"

#include <gmock/gmock.h>

#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::app {
namespace {

class Configuration : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    ConfigSources sources_{folder_ / "system.toml", folder_ / "user.toml", {}};

    std::string refusal()
    {
        try {
            readConfig(sources_);
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    }
};

TEST_F(Configuration, TheMachinesIsWeakerThanTheReadersAndThatWeakerThanTheCommandLine)
{
    replaceFile(sources_.system, "[queue]\nlease_s = 11\nmost_drops = 11\nmost_attempts = 11\n");
    replaceFile(sources_.user, "[queue]\nmost_drops = 22\nmost_attempts = 22\n");
    sources_.assignments = {"queue.most_attempts=33"};
    const Config config = readConfig(sources_);
    EXPECT_EQ(config.at("queue.lease_s").value, 11);
    EXPECT_EQ(config.at("queue.most_drops").value, 22);
    EXPECT_EQ(config.at("queue.most_attempts").value, 33);
}

TEST_F(Configuration, NobodyGivesRolesToHimselfWhereTheMachineGivesThem)
{
    sources_.assignments = {"roles.sign=me"};
    EXPECT_EQ(refusal(), "") << "the machine says nothing";
    replaceFile(sources_.system, "[roles]\nsign = [\"anna\"]\n");
    EXPECT_THAT(refusal(), testing::HasSubstr("roles are given by"));
    sources_.assignments.clear();
    EXPECT_EQ(readConfig(sources_).at("roles.sign").value, nlohmann::json::array({"anna"}));
    replaceFile(sources_.user, "[roles]\nmark = [\"me\"]\n");
    EXPECT_THAT(refusal(), testing::HasSubstr("roles.mark"));
}

/// As in a home that this user may not enter, but so for every user.
TEST_F(Configuration, ThatCannotBeLookedAtIsNotTakenForNone)
{
    sources_.user = folder_ / std::string(300, 'x');
    EXPECT_THAT(refusal(), testing::HasSubstr("cannot be looked at (File name too long); let this user read it"));
    sources_.user = sources_.system = folder_ / "not-there.toml";
    EXPECT_EQ(refusal(), "");
}

}  // namespace
}  // namespace vicon::app
