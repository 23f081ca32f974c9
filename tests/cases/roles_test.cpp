// Who may do what, by the accounts of the operating system.
#include "vicon/cases/roles.h"

#include <gmock/gmock.h>

#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/bridges.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/corrections.h"
#include "vicon/core/error.h"
#include "vicon/support/message_of.h"

namespace vicon {
namespace {

using support::messageOf;
using testing::HasSubstr;

class Roles : public testing::Test {
protected:
    const std::string me_ = thisPerson();

    ~Roles() override { setRoles({}); }
};

TEST_F(Roles, AreNamedByAccountOrGroup)
{
    std::string group = support::runCommand("id -gn").output;
    group.erase(group.find_last_not_of('\n') + 1);
    EXPECT_TRUE(isAmong(me_, {"nobody_else", me_}));
    EXPECT_TRUE(isAmong(me_, {"@" + group}));
    EXPECT_FALSE(isAmong(me_, {"@no_such_group", "@" + me_ + "_", "nobody_else"}));
    EXPECT_FALSE(isAmong("no_such_account", {"@" + group}));
    EXPECT_FALSE(isAmong(me_, {}));
}

TEST_F(Roles, AreEverybodysUntilSomebodyIsNamed)
{
    for (const Role role : {Role::read, Role::mark, Role::operate}) {
        setRoles({});
        EXPECT_EQ(messageOf([&] { requireRole(role); }), "");
        setRoles({.read = {"nobody_else"}, .mark = {"nobody_else"}, .operate = {"nobody_else"}});
        EXPECT_THAT(messageOf([&] { requireRole(role); }), HasSubstr("this account may not"));
        setRoles({.read = {me_}, .mark = {me_}, .operate = {me_}});
        EXPECT_EQ(messageOf([&] { requireRole(role); }), "");
    }
}

TEST_F(Roles, LetTheServicesAccountOperateAndNoMore)
{
    const RoleOptions options{.read = {"anna"}, .mark = {"anna"}, .operate = {"anna"}};
    EXPECT_TRUE(hasRole("vicon", Role::operate, options));
    EXPECT_FALSE(hasRole("vicon", Role::read, options));
    EXPECT_FALSE(hasRole("vicon", Role::mark, options));
    EXPECT_FALSE(hasRole("ben", Role::operate, options));
    EXPECT_TRUE(hasRole("anna", Role::operate, options));
}

TEST_F(Roles, HoldWhereSomethingIsSaidOfACase)
{
    test::MarkedCase marked;
    CaseStore& store = marked.store;
    setRoles({.mark = {"nobody_else"}});
    const Marker marker = store.markers("c1").at(0);
    const std::vector<std::function<void()>> acts = {
        [&] { store.saveMarker("c1", {.scan_id = "s1"}); },
        [&] { store.removeMarker("c1", "m1"); },
        [&] {
            store.editMarkers("c1", {{marker, std::nullopt}});
        },
        [&] { marked.add({"m1"}); },
        [&] { saveAssessment(store, "c1", {}, {}); },
        [&] { replaceCorrections(store, {}, marked.scan, {}); },
        [&] { reviewBridge(store, marked.scan, {}); },
    };
    for (const auto& act : acts)
        EXPECT_THAT(messageOf(act), HasSubstr("may not mark or assess"));
    EXPECT_EQ(store.markers("c1").size(), 3u);
    setRoles({.operate = {"nobody_else"}});
    NoProgress quiet;
    EXPECT_THAT(messageOf([&] { deleteCase(store, "c1", true, "", quiet); }), HasSubstr("may not do this"));
    EXPECT_TRUE(store.findCase("c1"));
}

}  // namespace
}  // namespace vicon
