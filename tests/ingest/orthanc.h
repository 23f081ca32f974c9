#pragma once

#include <arpa/inet.h>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <thread>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/support.h"

namespace vicon::test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kPatience = 60s;  // for a loaded machine; nothing waits so long when it works

/// Whether a peer comes to answer an echo.
inline bool comesToAnswer(const ingest::Peer& peer)
{
    return support::waitUntil([&] {
        try {
            ingest::echo(peer, "VICON");
            return true;
        } catch (const Error&) {
            return false;
        }
    });
}

/// The data set of a file: what follows the meta header.
inline std::string datasetBytes(const std::string& file)
{
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 140, 4);
    return file.substr(144 + length);
}

/// The transfer syntax and a hash of an object without what a network leaves out: group lengths and meta header.
inline std::string fingerprint(const std::string& file)
{
    const support::TemporaryFolder folder;
    std::ofstream(folder / "in.dcm", std::ios::binary) << file;
    DcmFileFormat format;
    EXPECT_TRUE(format.loadFile((folder / "in.dcm").c_str()).good());
    const E_TransferSyntax syntax = format.getDataset()->getOriginalXfer();
    EXPECT_TRUE(
        format.saveFile((folder / "out.dcm").c_str(), syntax, EET_ExplicitLength, EGL_withoutGL, EPD_withoutPadding)
            .good());
    return std::string(DcmXfer(syntax).getXferID()) + " " + sha256(datasetBytes(readFile(folder / "out.dcm")));
}

/// Gives the objects of a folder the descriptions of a colonography, prone.
inline void describe(const fs::path& folder)
{
    const auto done = support::runCommand("dcmodify -nb -i \"StudyDescription=CT COLONOGRAPHY\" -i " +
                                          ("\"SeriesDescription=prone 1.0\" " + folder.string()) + "/*.dcm");
    EXPECT_EQ(done.exit_code, 0) << done.output;
}

/// For servers that cannot be told to choose a port and say which (Orthanc, DCMTK's tools), and where two servers must
/// know each other's before either runs; VICON's own listener chooses by itself. Below those that the system gives to
/// connections: a test that opens thousands of them takes ports at any moment.
inline int freePort()
{
    constexpr int kFirst = 10000, kLast = 32000;
    static std::mt19937 dice(std::random_device{}());
    for (;;) {
        const int port = std::uniform_int_distribution(kFirst, kLast)(dice);
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_ANY);
        address.sin_port = htons(std::uint16_t(port));
        const bool is_free = ::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
        ::close(socket);
        if (is_free)
            return port;
    }
}

/// Orthanc's configuration of its DICOMweb service, and more.
inline nlohmann::json withDicomWeb(nlohmann::json more = nlohmann::json::object())
{
    more["Plugins"] = {"/usr/share/orthanc/plugins/libOrthancDicomWeb.so"};
    return more;
}

/// A PACS of somebody else's, for the length of a test.
class Orthanc {
public:
    /// With which files each side speaks TLS.
    struct Secured {
        ingest::TlsOptions orthanc, vicon;
    };
    /// @param vicon_port where "VICON" listens, for C-MOVE; 0: nowhere
    /// @param more of its configuration: plugins and what they are told
    explicit Orthanc(const fs::path& folder, int vicon_port = 0, const std::optional<Secured>& secured = {},
                     const nlohmann::json& more = nlohmann::json::object())
        : folder_(folder), dicom_port_(freePort()), http_port_(freePort()), secured_(secured)
    {
        fs::create_directories(folder);
        nlohmann::json config = {{"Name", "test"},
                                 {"StorageDirectory", folder.string()},
                                 {"IndexDirectory", folder.string()},
                                 {"RemoteAccessAllowed", false},
                                 {"AuthenticationEnabled", false},
                                 {"HttpPort", http_port_},
                                 {"DicomPort", dicom_port_},
                                 {"DicomAet", "ORTHANC"},
                                 {"DicomAlwaysAllowStore", true},
                                 {"DicomAlwaysAllowEcho", true},
                                 {"DicomAlwaysAllowFind", true},
                                 {"DicomAlwaysAllowGet", true},
                                 {"DicomAlwaysAllowMove", true},
                                 {"Plugins", nlohmann::json::array()}};
        if (vicon_port != 0)
            config["DicomModalities"]["vicon"] = {
                {"AET", "VICON"}, {"Host", "127.0.0.1"}, {"Port", vicon_port}, {"UseDicomTls", secured.has_value()}};
        if (secured)
            config.update({{"DicomTlsEnabled", true},
                           {"DicomTlsCertificate", secured->orthanc.certificate},
                           {"DicomTlsPrivateKey", secured->orthanc.key},
                           {"DicomTlsTrustedCertificates", secured->orthanc.trusted}});
        config.update(more);
        std::ofstream(folder / "orthanc.json") << config;
        start();
    }
    /// Starts it, again with what it had stored.
    void start()
    {
        process_ = ::fork();
        if (process_ == 0) {
            const std::string log = (folder_ / "log").string(), file = (folder_ / "orthanc.json").string();
            if (!std::freopen(log.c_str(), "w", stdout) || !std::freopen(log.c_str(), "a", stderr))
                std::_Exit(126);
            ::execlp("Orthanc", "Orthanc", file.c_str(), nullptr);
            std::_Exit(127);
        }
    }
    ~Orthanc() { end(SIGTERM); }
    void end(int signal)
    {
        if (process_ > 0)
            ::kill(process_, signal);
        if (process_ > 0)
            ::waitpid(process_, nullptr, 0);
        process_ = -1;
    }
    Orthanc(const Orthanc&) = delete;
    Orthanc& operator=(const Orthanc&) = delete;

    ingest::Peer peer() const
    {
        ingest::Peer peer{"orthanc", "127.0.0.1", "ORTHANC", dicom_port_};
        if (secured_)
            peer.tls = secured_->vicon;
        return peer;
    }
    /// By DICOMweb, with its plugin.
    ingest::Peer webPeer(const std::string& scheme = "http") const
    {
        ingest::Peer peer;
        peer.name = "web";
        peer.web = {scheme + "://localhost:" + std::to_string(http_port_) + "/dicom-web", "", ""};
        return peer;
    }
    bool answers() const { return comesToAnswer(peer()); }
    /// The body that a GET of its REST interface gives.
    std::string get(const std::string& path) const { return ask("GET " + path + " HTTP/1.0\r\n\r\n"); }
    std::string post(const std::string& path, const std::string& body) const
    {
        return ask("POST " + path + " HTTP/1.0\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    }

    /// How many objects it holds.
    std::size_t objects() const { return nlohmann::json::parse(get("/instances")).size(); }

private:
    std::string ask(const std::string& request) const
    {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(std::uint16_t(http_port_));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        std::string answer;
        if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
            EXPECT_EQ(::send(socket, request.data(), request.size(), MSG_NOSIGNAL), ssize_t(request.size()));
            char block[65536];
            for (ssize_t count = 0; (count = ::recv(socket, block, sizeof block, 0)) > 0;)
                answer.append(block, std::size_t(count));
        }
        ::close(socket);
        return answer.substr(std::min(answer.find("\r\n\r\n"), answer.size() - 4) + 4);
    }

    fs::path folder_;
    int dicom_port_, http_port_;
    std::optional<Secured> secured_;
    pid_t process_ = -1;
};

}  // namespace vicon::test
