#include "tls_layer.h"

#include <arpa/inet.h>
#include <dcmtk/dcmtls/tlstrans.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <cstdio>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
struct FreeCertificate {
    void operator()(X509* certificate) const { X509_free(certificate); }
};

[[noreturn]] void wrong(const std::string& what, const std::string& file, const std::string& option)
{
    std::string reason;
    if (const unsigned long number = ERR_peek_last_error(); number != 0)
        if (const char* text = ERR_reason_error_string(number))
            reason = std::string(" (") + text + ")";
    ERR_clear_error();
    throw Error(ErrorCode::wrong_use, what + reason, file.empty() ? option : file, "set " + option);
}

DcmTLSSecurityProfile profileOf(TlsProfile profile)
{
    switch (profile) {
        case TlsProfile::bcp195:
            return TSP_Profile_BCP195;
        case TlsProfile::bcp195_nd:
            return TSP_Profile_BCP195_ND;
        case TlsProfile::bcp195_extended:
            return TSP_Profile_BCP195_Extended;
    }
    throw Error(ErrorCode::internal, "no such TLS profile");
}

bool isAddress(const std::string& name)
{
    in6_addr any{};
    return ::inet_pton(AF_INET, name.c_str(), &any) == 1 || ::inet_pton(AF_INET6, name.c_str(), &any) == 1;
}

/// DCMTK checks whom a certificate leads to, and not whose it is.
class NamedLayer : public WatchingLayer {
public:
    NamedLayer(const TlsOptions& options, std::string name) : layer_(makeTlsLayer(options)), name_(std::move(name)) {}

    DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool) override
    {
        SSL* const ssl = SSL_new(layer_->getNativeHandle());
        if (!ssl || SSL_set_fd(ssl, socket) != 1 || !expectName(*ssl)) {
            SSL_free(ssl);
            return nullptr;
        }
        return new Watched<Acknowledging<DcmTLSConnection>>(newWatch(), socket, ssl);  // DCMTK's to delete
    }

private:
    bool expectName(SSL& ssl) const
    {
        if (name_.empty())
            return true;
        if (isAddress(name_))
            return X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(&ssl), name_.c_str()) == 1;
        SSL_set_tlsext_host_name(&ssl, name_.c_str());
        return SSL_set1_host(&ssl, name_.c_str()) == 1;
    }

    std::unique_ptr<DcmTLSTransportLayer> layer_;
    std::string name_;
};

}  // namespace

std::unique_ptr<DcmTLSTransportLayer> makeTlsLayer(const TlsOptions& options)
{
    DcmTLSTransportLayer::initializeOpenSSL();
    ERR_clear_error();
    auto layer = std::make_unique<DcmTLSTransportLayer>(NET_ACCEPTORREQUESTOR, nullptr, OFFalse);
    if (layer->setTLSProfile(profileOf(options.profile)).bad() || layer->activateCipherSuites().bad())
        wrong("this profile cannot be had", nameIn(kTlsProfileNames, options.profile), "tls.profile");
    layer->setPrivateKeyPasswd("");  // nobody is there to be asked for one
    if (layer->setPrivateKeyFile(options.key.c_str(), DCF_Filetype_PEM).bad())
        wrong("no key without a password can be read", options.key, "tls.key");
    if (SSL_CTX_use_certificate_chain_file(layer->getNativeHandle(), options.certificate.c_str()) != 1)
        wrong("no certificate can be read", options.certificate, "tls.certificate");
    if (!layer->checkPrivateKeyMatchesCertificate())
        wrong("the key is not that of the certificate", options.key, "tls.key");
    if (layer->addTrustedCertificateFile(options.trusted.c_str(), DCF_Filetype_PEM).bad())
        wrong("no certificates can be read", options.trusted, "tls.trusted");
    layer->setCertificateVerification(DCV_requireCertificate);
    return layer;
}

std::unique_ptr<WatchingLayer> tlsLayerFor(const Peer& peer)
{
    return std::make_unique<NamedLayer>(peer.tls.value(), peer.certificate_name.value_or(peer.host));
}

std::vector<CertificateTerm> certificateTerms(const TlsOptions& options)
{
    std::vector<CertificateTerm> terms;
    for (const auto& [file, option] :
         {std::pair(options.certificate, "tls.certificate"), {options.trusted, "tls.trusted"}}) {
        ERR_clear_error();
        const std::size_t before = terms.size();
        const std::unique_ptr<std::FILE, CloseFile> in(std::fopen(file.c_str(), "r"));
        while (const std::unique_ptr<X509, FreeCertificate> certificate{
            in ? PEM_read_X509(in.get(), nullptr, nullptr, nullptr) : nullptr}) {
            const ASN1_TIME* const end = X509_get0_notAfter(certificate.get());
            int days = 0, seconds = 0;
            std::tm date{};
            if (ASN1_TIME_diff(&days, &seconds, nullptr, end) != 1 || ASN1_TIME_to_tm(end, &date) != 1)
                wrong("a certificate does not say when it ends", file, option);
            char text[16];
            std::strftime(text, sizeof text, "%Y-%m-%d", &date);
            terms.push_back({file, text, seconds < 0 ? days - 1 : days});
        }
        if (terms.size() == before)
            wrong("no certificate can be read", file, option);
    }
    return terms;
}

}  // namespace vicon::ingest
