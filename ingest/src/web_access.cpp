#include "web_access.h"

#include <curl/curl.h>
#include <sys/stat.h>

#include <memory>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::ingest {
namespace {

struct FreeUrl {
    void operator()(CURLU* url) const { curl_url_cleanup(url); }
};

/// A part of a URL; empty where it has none.
std::string partOf(CURLU* url, CURLUPart part)
{
    char* text = nullptr;
    if (curl_url_get(url, part, &text, 0) != CURLUE_OK)
        return {};
    const std::unique_ptr<char, void (*)(void*)> owned(text, curl_free);
    return owned.get();
}

bool isThisMachine(const std::string& host)
{
    return host == "localhost" || host == "[::1]" || host.starts_with("127.");
}

[[noreturn]] void wrongAccess(const std::string& what, const std::string& subject, const std::string& remedy)
{
    throw Error(ErrorCode::wrong_use, what, subject, remedy);
}

}  // namespace

void requireUsable(const WebAccess& web, bool with_certificates)
{
    const std::unique_ptr<CURLU, FreeUrl> url(curl_url());
    const bool understood = curl_url_set(url.get(), CURLUPART_URL, web.url.c_str(), 0) == CURLUE_OK;
    const std::string scheme = partOf(url.get(), CURLUPART_SCHEME), host = partOf(url.get(), CURLUPART_HOST);
    if (!understood || (scheme != "http" && scheme != "https") || host.empty() ||
        !partOf(url.get(), CURLUPART_QUERY).empty() || !partOf(url.get(), CURLUPART_FRAGMENT).empty())
        wrongAccess("this is no URL of a DICOMweb service", "'" + web.url + "'", "write url = \"https://HOST/PATH\"");
    if (!partOf(url.get(), CURLUPART_USER).empty() || !partOf(url.get(), CURLUPART_PASSWORD).empty())
        wrongAccess("a user is not given in the URL", host, "set user and password_file");
    if (web.user.empty() != web.password_file.empty())
        wrongAccess("user and password_file go together", web.url, "set both or none");
    if (scheme == "http" && with_certificates)
        wrongAccess("TLS is spoken by https alone", web.url, "write https, or leave tls out");
    if (scheme == "http" && !web.user.empty() && !isThisMachine(host))
        wrongAccess("the password would travel unencrypted", web.url, "write https");
}

std::string passwordOf(const WebAccess& web)
{
    if (web.user.empty())
        return {};
    struct stat about {};
    if (::stat(web.password_file.c_str(), &about) != 0)
        wrongAccess("the password cannot be read", web.password_file,
                    "set password_file to a file that holds it alone");
    if ((about.st_mode & S_IRWXO) != 0)
        wrongAccess("everybody may read the password", web.password_file, "chmod 640 it");
    std::string password = readFile(web.password_file);
    while (password.ends_with('\n') || password.ends_with('\r'))
        password.pop_back();
    return password;
}

}  // namespace vicon::ingest
