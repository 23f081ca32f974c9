// A worklist of a million cases: vicon_scale_bench FOLDER [CASES [ADDRESS]] fills a store that is empty, in SQLite or
// in the PostgreSQL database at ADDRESS, and times its first page, later pages, searches, a claim and what a worker
// asks.
#include <soci/soci.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "vicon/cases/worklist.h"

namespace vicon {
namespace {

constexpr int kRounds = 40;

/// Numbers from 1 on, in both databases' words.
std::string numbers(int count)
{
    return " WITH RECURSIVE numbers(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM numbers WHERE n < " +
           std::to_string(count) + ") SELECT ";
}

void fill(CaseStore& store, int cases)
{
    const std::string id = "'c' || CAST(1000000000 + n AS TEXT)", name = "'name' || CAST(n % 50000 AS TEXT)",
                      given = "'given' || CAST(n % 3000 AS TEXT)", patient = "'P' || CAST(n AS TEXT)";
    const std::string from = " FROM numbers";
    // One in ten waits, the others are done; ten run.
    const std::string state = "CASE WHEN n <= 10 THEN 'running' WHEN n % 10 = 0 THEN 'queued' ELSE 'done' END";
    store.database().write([&](soci::session& sql) {
        sql << "INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags, created)" +
                   numbers(cases) + id + ", '1.2.3.' || CAST(n AS TEXT), " + patient + ", " + name + " || '^' || " +
                   given +
                   ", '19600101', 'F', '{\"uid\":\"1.2.3\", \"date\":\"20260102\"}', '[]', '2026-01-02T' ||"
                   " CAST(10000000 + n AS TEXT)" +
                   from;
        for (const std::string& word : {name, given, "lower(" + patient + ")", id})
            sql << "INSERT INTO case_words (word, case_id)" + numbers(cases) + word + ", " + id + from;
        for (const std::string scan : {"s1", "s2"}) {
            sql << "INSERT INTO scans (id, case_id, series_uid, series, role, ingest, created)" + numbers(cases) + "'" +
                       scan + "', " + id + ", '1.2', '{\"number\":1, \"patient_position\":\"HFS\"}', 'scan', '{}', ''" +
                       from;
            sql << "INSERT INTO jobs (case_id, scan_id, state, attempts, not_before, fence, owner, lease_until, step,"
                   " progress, reason, changed, queued, sender, turn)" +
                       numbers(cases) + id + ", '" + scan + "', " + state +
                       ", 0, 0, 1, 'elsewhere/x/1/1', 9e9, '', 0, '', '', n, 'CT' || CAST(n % 7 AS TEXT), n" + from;
        }
    });
    if (!store.place().database.empty())
        store.database().session() << "ANALYZE";
}

/// Over a connection that is closed then, so that SQLite brings its log into the file.
void fillIfEmpty(const StorePlace& place, int cases)
{
    CaseStore store(place);
    if (!makeWorklistPage(store, {}, {.most = 1}).cases.empty())
        return;
    const auto begin = std::chrono::steady_clock::now();
    fill(store, cases);
    std::printf("%d cases of two scans, filled in %.0f s\n", cases,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

template <class Work>
void time(const char* what, Work work)
{
    std::vector<double> took_ms;
    const std::clock_t cpu_begin = std::clock();
    for (int n = 0; n < kRounds; ++n) {
        const auto begin = std::chrono::steady_clock::now();
        work(n);
        took_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(took_ms.begin(), took_ms.end());
    const double cpu_ms = 1000.0 * double(std::clock() - cpu_begin) / CLOCKS_PER_SEC / kRounds;
    std::printf("%-36s best %7.2f ms, median %7.2f ms, longest %7.2f ms, of this program's processor %6.2f ms\n", what,
                took_ms.front(), took_ms[took_ms.size() / 2], took_ms.back(), cpu_ms);
    std::fflush(stdout);
}

int run(int argc, char** argv)
{
    if (argc < 2)
        throw std::runtime_error("vicon_scale_bench FOLDER [CASES [ADDRESS]]");
    const int cases = argc > 2 ? std::atoi(argv[2]) : 1'000'000;
    const StorePlace place(argv[1], argc > 3 ? argv[3] : "");
    fillIfEmpty(place, cases);
    CaseStore store(place);
    const QueueOptions options{.lease_s = 1e9};
    JobQueue queue(store.database(), options);
    std::string after;
    time("opening the store", [&](int) { CaseStore again(place); });
    time("first page of 50", [&](int) {
        const WorklistPage page = makeWorklistPage(store, options, {.most = 50});
        if (page.cases.size() != 50 || page.cases[0].scans.size() != 2)
            throw std::runtime_error("not a page");
        after = page.cases.back().record.id;
    });
    time("the pages after it",
         [&](int) { after = makeWorklistPage(store, options, {.most = 50, .after = after}).cases.back().record.id; });
    const auto search = [&](const std::string& words) {
        if (makeWorklistPage(store, options, {.most = 50, .words = words}).cases.empty())
            throw std::runtime_error("nothing found");
    };
    time("search for an ID", [&](int n) { search("p" + std::to_string(1 + n * 97)); });
    time("search for a name", [&](int n) { search("name" + std::to_string(1 + n * 31)); });
    time("search for name and given name", [&](int n) {
        const int k = cases / 2 + n;
        search("name" + std::to_string(k % 50000) + " given" + std::to_string(k % 3000));
    });
    time("search for what a third begin with", [&](int) { search("given1"); });
    time("claim", [&](int) {
        if (!queue.claim("elsewhere/x/1/1"))
            throw std::runtime_error("no job");
    });
    time("when the next job is due", [&](int) { queue.nextDue(); });
    return 0;
}

}  // namespace
}  // namespace vicon

int main(int argc, char** argv)
{
    try {
        return vicon::run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
