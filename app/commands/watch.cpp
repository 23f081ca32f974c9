#include "vicon/ingest/watch.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <optional>
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

/// Nothing of a library's.
std::optional<ErrorCode> codeOf(const std::exception& e)
{
    const auto* error = dynamic_cast<const Error*>(&e);
    return error ? std::optional(error->code()) : std::nullopt;
}

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
        for (const ingest::FoundStudy& study : ingest::findStudies(
                 peer_, {.dates = since + "-", .modality = ingest::modalityAsked(rule_)}, title_, progress_)) {
            if (stopRequested())
                return all;
            all = unlessItFails(study.study_uid, [&] { return take(study); }) && all;
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

    /// What fails with one study is said, and keeps nobody from the others.
    template <class Act>
    static bool unlessItFails(const std::string& study_uid, Act act)
    {
        try {
            return act();
        } catch (const std::exception& e) {  // a library's, too
            if (codeOf(e) == ErrorCode::cancelled || codeOf(e) == ErrorCode::wrong_use)
                throw;
            spdlog::warn("case {} is fetched again later: {}", CaseStore::caseIdFor(study_uid), e.what());
            return false;
        }
    }

    bool take(const ingest::FoundStudy& study)
    {
        const auto series = ingest::describeSeries(peer_, study.study_uid, title_, progress_);
        if (!ingest::fits(rule_, study, series))
            return true;
        const int images = imagesIn(series);
        if (watched_.note(study.study_uid, study.date, images)) {
            if (!fetch(study.study_uid, ingest::imageSeries(rule_, series)))
                return false;
            watched_.markFetched(study.study_uid, images);
        }
        if (!watched_.awaitsPriors(study.study_uid))
            return true;
        if (!takePriors(study))
            return false;
        watched_.markPriorsFetched(study.study_uid);
        return true;
    }

    bool fetch(const std::string& study_uid, const std::vector<std::string>& series)
    {
        const std::string case_id = CaseStore::caseIdFor(study_uid);
        const Fetched fetched = fetchSeries(context_, study_uid, peer_, series, progress_);
        for (const ingest::ImportLine& line : fetched.report.lines)
            spdlog::info("{} {}: {}", ingest::nameOf(line.kind), line.subject, line.text);
        for (const std::string& reason : fetched.result.reasons)
            spdlog::warn("case {}: {}", case_id, reason);
        spdlog::info("case {}: {} objects fetched, {} failed", case_id, fetched.result.completed,
                     fetched.result.failed);
        return fetched.result.failed == 0;
    }

    /// The newest ones before the study, each with its reports. One that fails leaves the others.
    bool takePriors(const ingest::FoundStudy& study)
    {
        if (rule_.priors == 0 || study.patient_id.empty() || study.date.empty())
            return true;
        if (!ingest::isDicomDate(study.date)) {
            spdlog::warn("case {}: the study's date is none; its priors are not looked for",
                         CaseStore::caseIdFor(study.study_uid));
            return true;
        }
        auto priors = ingest::findStudies(
            peer_,
            {.patient_id = study.patient_id, .dates = "-" + study.date, .modality = ingest::modalityAsked(rule_)},
            title_, progress_);
        std::reverse(priors.begin(), priors.end());
        int left = rule_.priors;
        bool all = true;
        for (const ingest::FoundStudy& prior : priors) {
            if (left == 0 || prior.study_uid == study.study_uid || prior.patient_id != study.patient_id)
                continue;
            all = unlessItFails(prior.study_uid, [&] { return takePrior(prior, left); }) && all;
        }
        return all;
    }

    bool takePrior(const ingest::FoundStudy& prior, int& left)
    {
        const auto series = ingest::describeSeries(peer_, prior.study_uid, title_, progress_);
        if (!ingest::fits(rule_, prior, series))
            return true;
        --left;
        const int images = imagesIn(series);
        std::vector<std::string> wanted = ingest::reportSeries(series);
        // A case that the store has otherwise stays as it is.
        const bool with_images =
            watched_.awaitsFetch(prior.study_uid) || !context_.store().findCaseByStudy(prior.study_uid);
        if (with_images) {
            watched_.note(prior.study_uid, prior.date, images);
            for (std::string& uid : ingest::imageSeries(rule_, series))
                wanted.push_back(std::move(uid));
        }
        if (wanted.empty())
            return true;
        if (!fetch(prior.study_uid, wanted))
            return false;
        if (with_images)
            watched_.markFetched(prior.study_uid, images);
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
        } catch (const std::exception& e) {  // a library's, too, at what the peer said
            if (once || codeOf(e) == ErrorCode::wrong_use)
                throw;
            if (said != e.what() && codeOf(e) != ErrorCode::cancelled)
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
    return {"watch", "Ask a PACS again and again for new studies that fit [watch], and fetch each once",
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
