#pragma once

#include <string>
#include <vector>

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"

namespace vicon::ingest {

/// Secure transport connection profiles of DICOM PS3.15 annex B: BCP 195, without downgrade, extended.
enum class TlsProfile { bcp195, bcp195_nd, bcp195_extended };
inline constexpr EnumNames<TlsProfile, 3> kTlsProfileNames{{
    {TlsProfile::bcp195, "bcp195"},
    {TlsProfile::bcp195_nd, "bcp195_nd"},
    {TlsProfile::bcp195_extended, "bcp195_extended"},
}};
constexpr const auto& optionNames(TlsProfile /*value*/)
{
    return kTlsProfileNames;
}

/// Whether callers speak TLS.
enum class TlsUse { off, offered, required };
inline constexpr EnumNames<TlsUse, 3> kTlsUseNames{{
    {TlsUse::off, "off"},
    {TlsUse::offered, "offered"},
    {TlsUse::required, "required"},
}};
constexpr const auto& optionNames(TlsUse /*value*/)
{
    return kTlsUseNames;
}

/// With which files VICON speaks TLS, as the one who calls and the one who is called: see receive.tls and [peers].
struct TlsOptions {
    std::string certificate;
    std::string key;
    std::string trusted;
    TlsProfile profile = TlsProfile::bcp195;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("tls.certificate", certificate, "",
          "PEM file of the own certificate, followed by those between it and its root. A replaced file is used for the "
          "next connection.");
        v("tls.key", key, "", "PEM file of the certificate's key, without a password.");
        v("tls.trusted", trusted, "", "PEM file of the certificates that a peer's certificate must lead to.");
        v("tls.profile", profile, "",
          "Secure transport connection profile of DICOM PS3.15: BCP 195, without downgrade, or extended.",
          choicesOf(profile));
    }

    friend bool operator==(const TlsOptions&, const TlsOptions&) = default;
};

/// How long a certificate is good for.
struct CertificateTerm {
    std::string file;
    std::string ends;   ///< "2027-03-01"
    int days_left = 0;  ///< negative: it is over
};

/// Of every certificate in the files, those of peers' authorities as well. Throws Error{wrong_use} for a file that
/// holds none.
std::vector<CertificateTerm> certificateTerms(const TlsOptions& options);

}  // namespace vicon::ingest
