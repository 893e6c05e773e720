// What calls of azulejo.hpp throw.
#pragma once

#include <cstring>

#include <azulejo.hpp>

/// True for a call that throws an Error of this status, with this in its message.
template <class Call>
bool throws(azulejo_status status, const char *part, Call call) {
    try {
        call();
        return false;
    } catch (const azulejo::Error &error) {
        return error.status() == status && std::strstr(error.what(), part) != nullptr;
    }
}

/// True if an argument of a call is refused with this in the message.
template <class Call>
bool refused(const char *part, Call call) {
    return throws(AZULEJO_ERROR_INVALID_ARGUMENT, part, call);
}
