/* The checks of the C test programs: each says what failed and goes on; finish() counts them. */

#ifndef AZULEJO_TESTS_CHECK_H
#define AZULEJO_TESTS_CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <azulejo.h>

#define CHECK(condition) check((condition) != 0, __FILE__, __LINE__, #condition)

/* The call succeeds. */
#define ACCEPTED(call) check_accepted((call), __FILE__, __LINE__, #call)

/* The call fails with this status, and its message has this in it. */
#define REFUSED(status, part, call) check_refused((call), (status), (part), __FILE__, __LINE__, #call)

/* What an output holds before a call; a call that fails leaves it. */
#define UNTOUCHED ((void *)&check_counts)

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

static struct {
    int passed, failed;
} check_counts;

static inline int check(int ok, const char *file, int line, const char *what) {
    if (ok) {
        check_counts.passed++;
    } else {
        check_counts.failed++;
        printf("%s:%d: failed: %s\n", file, line, what);
    }
    return ok;
}

/* The last error of this thread; the text lives until the next call. */
static inline const char *last_error(void) {
    static char message[1024];
    azulejo_last_error_message(message, sizeof message);
    return message;
}

static inline int check_accepted(azulejo_status status, const char *file, int line, const char *what) {
    const int ok = check(status == AZULEJO_OK, file, line, what);
    if (!ok) printf("    status %d: %s\n", (int)status, last_error());
    return ok;
}

static inline void check_refused(azulejo_status status, azulejo_status expected, const char *part, const char *file,
                                 int line, const char *what) {
    const int named = status != AZULEJO_OK && strstr(last_error(), part) != NULL;
    if (!check(status == expected && named, file, line, what))
        printf("    status %d instead of %d, \"%s\" in: %s\n", (int)status, (int)expected, part,
               status == AZULEJO_OK ? "(success)" : last_error());
}

/* The program's exit code. */
static inline int finish(void) {
    printf("%d passed, %d failed\n", check_counts.passed, check_counts.failed);
    return check_counts.failed == 0 && check_counts.passed > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
