#include "vicon/viewer/model/scan_opening.h"

#include <utility>

namespace vicon::viewer {

void ScanOpening::ask(const ScanRequest& request, const std::optional<From>& from)
{
    const bool same = asked_ && asked_->scan_id == request.scan_id;
    const bool redone_by_other = same && asked_->redone_by_other;
    owes_markers_ = owes_markers_ || request.redone;
    asked_ = request;
    asked_->redone_by_other = request.redone_by_other || redone_by_other;
    from_ = from;
}

void ScanOpening::giveUp()
{
    asked_.reset();
    from_.reset();
}

Arrival ScanOpening::opened(const std::string& scan_id)
{
    const ScanRequest request = std::exchange(asked_, {}).value_or(ScanRequest{});
    const std::optional<From> from = std::exchange(from_, {});
    Arrival arrival;
    if (from && from->scan_id == scan_id)
        arrival.place = SamePlace{request.go_to_mm};
    else if (from)
        arrival.place = CorrespondingPlace{from->station_mm};
    arrival.marker_id = request.marker_id;
    arrival.place_markers = std::exchange(owes_markers_, false);
    arrival.redone_by_other = request.redone_by_other;
    return arrival;
}

std::optional<ScanRequest> ScanOpening::observed(const ScanObserved& scan)
{
    if (scan.own_work)
        return std::nullopt;
    if (scan.in_work) {
        in_work_elsewhere_ = true;
        return std::nullopt;
    }
    if (!std::exchange(in_work_elsewhere_, false) || !scan.readable || !scan.made_anew)
        return std::nullopt;
    ScanRequest request;
    request.scan_id = scan.scan_id;
    request.read_again = request.redone = request.redone_by_other = true;
    return request;
}

}  // namespace vicon::viewer
