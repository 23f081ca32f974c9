#pragma once

#include <optional>
#include <string>

#include "vicon/core/option_names.h"
#include "vicon/ingest/tls.h"

namespace vicon::ingest {

/// Where a peer is asked by DICOMweb (QIDO-RS, WADO-RS, STOW-RS), and as whom.
struct WebAccess {
    std::string url;                  ///< its root, as https://pacs.example.org/dicom-web
    std::string user, password_file;  ///< empty: as nobody in particular
};

/// How objects are fetched from a peer: over the association that asks (C-GET), or sent to our listener (C-MOVE).
enum class RetrieveMethod { get, move };
inline constexpr EnumNames<RetrieveMethod, 2> kRetrieveMethodNames{
    {{RetrieveMethod::get, "get"}, {RetrieveMethod::move, "move"}}};
constexpr const auto& optionNames(RetrieveMethod /*value*/)
{
    return kRetrieveMethodNames;
}

/// A DICOM application on the network, and what it may do here.
struct Peer {
    std::string name;  ///< as the configuration calls it
    std::string host;
    std::string ae_title;
    int port = 104;
    bool stores = true;      ///< it may store objects here, and ask for a commitment to them
    bool is_queried = true;  ///< it is asked for studies, and they are fetched from it
    bool is_sent = true;     ///< objects are sent to it, and it may report its commitment to them
    RetrieveMethod retrieve = RetrieveMethod::get;  ///< by DICOMweb there is no other
    int max_associations = 0;                       ///< that it may have open here at a time; 0: as many as its host
    double mb_per_s = 0;                            ///< that are taken of it; 0: as many as come
    /// With which files TLS is spoken; none: it is not. A peer that is called by TLS must call by it.
    std::optional<TlsOptions> tls = {};
    /// What its certificate must name; none: its host; empty: whatever leads to a trusted one.
    std::optional<std::string> certificate_name = {};
    /// Queries, retrievals and storage go this way; without a host it is reached by no other.
    std::optional<WebAccess> web = {};
};

/// "ORTHANC at 10.0.0.5:104", or its URL.
std::string whereIs(const Peer& peer);

/// Throws Error{wrong_use} for a URL, or a user, that cannot be used; also where a password would travel unencrypted to
/// another machine.
void requireUsable(const WebAccess& web, bool with_certificates);

}  // namespace vicon::ingest
