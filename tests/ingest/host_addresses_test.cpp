// Hosts that are given by name, and name servers that are off, slow or change their mind.
#include "host_addresses.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "vicon/support/support.h"

namespace vicon::test {
namespace {

using namespace std::chrono_literals;
using ingest::HostAddresses;
using Addresses = std::vector<std::string>;

constexpr HostAddresses::Intervals kSoon{1ms, 1ms};

TEST(HostAddresses, ANameServerThatWasOffIsAskedAgain)
{
    const auto on = std::make_shared<std::atomic<bool>>(false);  // its thread may be about to ask once more
    const HostAddresses addresses(
        {"scanner", ""},
        [on](const std::string&) {
            return *on ? Addresses{"10.0.0.1", "10.0.0.2"} : Addresses{};
        },
        kSoon);
    EXPECT_FALSE(addresses.isKnown("scanner"));
    EXPECT_FALSE(addresses.has("scanner", ""));
    *on = true;
    EXPECT_TRUE(support::waitUntil([&] { return addresses.has("scanner", "10.0.0.2"); })) << "each of several";
    EXPECT_FALSE(addresses.has("scanner", "10.0.0.3"));
    EXPECT_FALSE(addresses.has("stranger", "10.0.0.2"));
    EXPECT_FALSE(addresses.isKnown(""));
}

TEST(HostAddresses, WhatWasKnownCountsUntilAnotherAnswer)
{
    const auto asked = std::make_shared<std::atomic<int>>(0);
    const HostAddresses addresses(
        {"scanner"},
        [asked](const std::string&) -> Addresses {
            const int n = (*asked)++;
            return n == 0 ? Addresses{"10.0.0.1"} : n < 100 ? Addresses{} : Addresses{"10.0.0.9"};
        },
        kSoon);
    EXPECT_TRUE(support::waitUntil([&] { return *asked > 2; }));
    EXPECT_TRUE(addresses.isKnown("scanner"));
    EXPECT_TRUE(support::waitUntil([&] { return addresses.has("scanner", "10.0.0.9"); })) << "it moved";
    EXPECT_FALSE(addresses.has("scanner", "10.0.0.1"));
}

TEST(HostAddresses, NobodyWaitsForANameServerThatDoesNotAnswer)
{
    auto answer = std::make_shared<std::promise<void>>();
    {
        const std::shared_future<void> answered = answer->get_future();
        const HostAddresses addresses(
            {"scanner"},
            [answered](const std::string&) -> Addresses {
                answered.wait();
                return {"10.0.0.1"};
            },
            kSoon);
        EXPECT_FALSE(addresses.isKnown("scanner"));
    }
    answer->set_value();  // its thread ends by itself
}

}  // namespace
}  // namespace vicon::test
