/* The Embree 4 API over the installed Embree, 4 or 3.13: what bindgen reads, and what cc compiles.
 *
 * AZULEJO_EMBREE_MAJOR, from build.rs, says which headers there are. A function `azulejo_rtcX` is the `rtcX` of
 * Embree 4, where 3.13 has another one of that name or either has it inline only. None of them calls the library by
 * name, which would link it: a query is given the library's function. */
#pragma once

#if AZULEJO_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#define AZULEJO_PARAMETERS(type) struct type *rayhit, struct RTCIntersectArguments *arguments
#define AZULEJO_QUERY(rayhit, arguments) rayhit, arguments
#else
#include <embree3/rtcore.h>
#if RTC_VERSION < 31300
#error "Embree 3.13 or later is needed"
#endif

/* What Embree 4 renamed or moved. In 3.13 one context carries the flags, the filter and the instance stack; Embree 4
 * splits it into the arguments of a query and its context. */

enum AzulejoSceneFlags {
  RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
};

enum RTCRayQueryFlags {
  RTC_RAY_QUERY_FLAG_NONE = 0,
  RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER = 1 << 1,
  RTC_RAY_QUERY_FLAG_INCOHERENT = 0,
  RTC_RAY_QUERY_FLAG_COHERENT = 1 << 16
};

/* As in Embree 4, a program makes it the first member of a struct of its own, and a filter finds it at `context`. */
struct RTCRayQueryContext {
  struct RTCIntersectContext context;
};

struct RTCIntersectArguments {
  enum RTCRayQueryFlags flags;
  struct RTCRayQueryContext *context;
  RTCFilterFunctionN filter;
};

static inline void rtcInitRayQueryContext(struct RTCRayQueryContext *context) {
  rtcInitIntersectContext(&context->context);
}

static inline void rtcInitIntersectArguments(struct RTCIntersectArguments *arguments) {
  arguments->flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments->context = NULL;
  arguments->filter = NULL;
}

/* The 3.13 context of a query: the caller's, or `fallback` if there is none, with the flags and filter of the query.
 * A caller's context is written, as its instance stack is: as in Embree 4 it serves one query at a time. */
static inline struct RTCIntersectContext *azulejo_context(const struct RTCIntersectArguments *arguments,
                                                          struct RTCRayQueryContext *fallback) {
  struct RTCIntersectContext *context;
  rtcInitRayQueryContext(fallback);
  context = arguments->context ? &arguments->context->context : &fallback->context;
  context->flags = arguments->flags & RTC_RAY_QUERY_FLAG_COHERENT ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                                  : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  context->filter = arguments->flags & RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER ? arguments->filter : NULL;
  return context;
}

/* What follows `valid, scene` in a declaration and in a call of rtcIntersectN. */
#define AZULEJO_PARAMETERS(type) struct RTCIntersectContext *context, struct type *rayhit
#define AZULEJO_QUERY(rayhit, arguments) azulejo_context(arguments, &(struct RTCRayQueryContext){0}), rayhit
#endif

/* The library's rtcIntersectN. */
typedef void AzulejoIntersect1(RTCScene scene, AZULEJO_PARAMETERS(RTCRayHit));
typedef void AzulejoIntersect4(const int *valid, RTCScene scene, AZULEJO_PARAMETERS(RTCRayHit4));
typedef void AzulejoIntersect8(const int *valid, RTCScene scene, AZULEJO_PARAMETERS(RTCRayHit8));
typedef void AzulejoIntersect16(const int *valid, RTCScene scene, AZULEJO_PARAMETERS(RTCRayHit16));

static inline void azulejo_rtcIntersect1(AzulejoIntersect1 *intersect, RTCScene scene, struct RTCRayHit *rayhit,
                                         struct RTCIntersectArguments *arguments) {
  intersect(scene, AZULEJO_QUERY(rayhit, arguments));
}

static inline void azulejo_rtcIntersect4(AzulejoIntersect4 *intersect, const int *valid, RTCScene scene,
                                         struct RTCRayHit4 *rayhit, struct RTCIntersectArguments *arguments) {
  intersect(valid, scene, AZULEJO_QUERY(rayhit, arguments));
}

static inline void azulejo_rtcIntersect8(AzulejoIntersect8 *intersect, const int *valid, RTCScene scene,
                                         struct RTCRayHit8 *rayhit, struct RTCIntersectArguments *arguments) {
  intersect(valid, scene, AZULEJO_QUERY(rayhit, arguments));
}

static inline void azulejo_rtcIntersect16(AzulejoIntersect16 *intersect, const int *valid, RTCScene scene,
                                          struct RTCRayHit16 *rayhit, struct RTCIntersectArguments *arguments) {
  intersect(valid, scene, AZULEJO_QUERY(rayhit, arguments));
}

static inline void azulejo_rtcInitRayQueryContext(struct RTCRayQueryContext *context) {
  rtcInitRayQueryContext(context);
}

static inline void azulejo_rtcInitIntersectArguments(struct RTCIntersectArguments *arguments) {
  rtcInitIntersectArguments(arguments);
}

/* The sizes of the structs that cross the FFI boundary, as the C compiler sees them. */
struct AzulejoSizes {
  size_t ray_hit, ray_hit4, ray_hit8, ray_hit16, hit, ray_query_context, intersect_arguments;
};

static inline struct AzulejoSizes azulejo_sizes(void) {
  struct AzulejoSizes sizes = {
      sizeof(struct RTCRayHit), sizeof(struct RTCRayHit4),         sizeof(struct RTCRayHit8),
      sizeof(struct RTCRayHit16), sizeof(struct RTCHit),           sizeof(struct RTCRayQueryContext),
      sizeof(struct RTCIntersectArguments)};
  return sizes;
}
