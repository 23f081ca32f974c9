#include "vicon/ingest/watch.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "../command.h"
#include "../fetching.h"
#include "../peers.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/watched_studies.h"

namespace vicon::app {
namespace {

/// Looks at a peer and fetches what fits the rule.
class Watch {
public:
    Watch(Context& context, const std::string& peer)
        : context_(context),
          peer_(requirePeer(context.config(), peer, PeerUse::query)),
          title_(context.config().get<ingest::ReceiverOptions>().ae_title),
          rule_(context.config().get<ingest::WatchOptions>()),
          watched_(context.store().folder(), peer)
    {
    }

    double pollSeconds() const { return rule_.poll_s; }

    /// One poll. Returns whether all that was due was fetched. What fails is said, and due again at the next.
    bool look()
    {
        const std::string since = ingest::watchedSince(rule_, today(), watched_.newestDate());
        bool all = true;
        for (const ingest::FoundStudy& study :
             ingest::findStudies(peer_, {.dates = since + "-", .modality = rule_.modality}, title_, progress_)) {
            if (stopRequested())
                return all;
            const auto series = ingest::describeSeries(peer_, study.study_uid, title_, progress_);
            if (ingest::fits(rule_, study, series))
                all = take(study, series) && all;
        }
        return all;
    }

private:
    static std::string today()
    {
        std::string date = nowUtc().substr(0, 10);
        std::erase(date, '-');
        return date;
    }

    static int imagesIn(const std::vector<ingest::FoundSeries>& series)
    {
        int images = 0;
        for (const ingest::FoundSeries& one : series)
            images += std::max(one.images, 1);
        return images;
    }

    bool take(const ingest::FoundStudy& study, const std::vector<ingest::FoundSeries>& series)
    {
        const int images = imagesIn(series);
        if (!watched_.note(study.study_uid, study.date, images))
            return true;
        if (!fetch(study.study_uid, series))
            return false;
        watched_.markFetched(study.study_uid, images);
        return takePriors(study);
    }

    bool fetch(const std::string& study_uid, const std::vector<ingest::FoundSeries>& series)
    {
        const std::string case_id = CaseStore::caseIdFor(study_uid);
        try {
            std::vector<std::string> uids;
            for (const ingest::FoundSeries& one : series)
                if (one.modality == rule_.modality)
                    uids.push_back(one.uid);
            const Fetched fetched = fetchByGet(context_, study_uid, peer_, uids, progress_);
            for (const ingest::ImportLine& line : fetched.report.lines)
                spdlog::info("{} {}: {}", ingest::nameOf(line.kind), line.subject, line.text);
            for (const std::string& reason : fetched.result.reasons)
                spdlog::warn("case {}: {}", case_id, reason);
            spdlog::info("case {}: {} objects fetched, {} failed", case_id, fetched.result.completed,
                         fetched.result.failed);
            return fetched.result.failed == 0;
        } catch (const Error& e) {
            if (e.code() == ErrorCode::cancelled)
                throw;
            spdlog::warn("case {} is fetched again later: {}", case_id, e.what());
            return false;
        }
    }

    /// The newest ones before the study.
    bool takePriors(const ingest::FoundStudy& study)
    {
        if (rule_.priors == 0 || study.patient_id.empty())
            return true;
        auto priors = ingest::findStudies(
            peer_, {.patient_id = study.patient_id, .dates = "-" + study.date, .modality = rule_.modality}, title_,
            progress_);
        std::reverse(priors.begin(), priors.end());
        int left = rule_.priors;
        for (const ingest::FoundStudy& prior : priors) {
            if (left == 0 || prior.study_uid == study.study_uid || prior.patient_id != study.patient_id)
                continue;
            const auto series = ingest::describeSeries(peer_, prior.study_uid, title_, progress_);
            if (!ingest::fits(rule_, prior, series))
                continue;
            --left;
            if (!context_.store().findCaseByStudy(prior.study_uid) && !fetch(prior.study_uid, series))
                return false;
        }
        return true;
    }

    Context& context_;
    const ingest::Peer peer_;
    const std::string title_;
    const ingest::WatchOptions rule_;
    ingest::WatchedStudies watched_;
    UntilStopped progress_;
};

int watch(Context& context, const std::string& peer, bool once)
{
    constexpr auto kLook = std::chrono::milliseconds(200);
    Watch watch(context, peer);
    std::string said;
    while (!stopRequested()) {
        const auto next = std::chrono::steady_clock::now() + std::chrono::duration<double>(watch.pollSeconds());
        try {
            const bool all = watch.look();
            if (once)
                return all ? 0 : 1;
            said.clear();
        } catch (const Error& e) {
            if (once || e.code() == ErrorCode::wrong_use)
                throw;
            if (said != e.what() && e.code() != ErrorCode::cancelled)
                spdlog::warn("{}", said = e.what());
        }
        while (std::chrono::steady_clock::now() < next && !stopRequested())
            std::this_thread::sleep_for(kLook);
    }
    return 0;
}

}  // namespace

Subcommand watchCommand()
{
    return {"watch", "Ask a PACS again and again for new studies that fit [watch], and fetch each once (C-FIND, C-GET)",
            [](CommandLine& command) {
                auto peer = std::make_shared<std::string>();
                auto once = std::make_shared<bool>(false);
                command.option("PEER", *peer, "Name of a peer in the configuration").required();
                command.flag("--once", *once,
                             "Ask once; a study is fetched when it has not grown since the time before");
                return [peer, once](Context& context) { return watch(context, *peer, *once); };
            }};
}

}  // namespace vicon::app
