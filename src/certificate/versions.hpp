// Arb's header, which lies in FLINT's folder from FLINT 3 on (Debian 13), and by itself before (Debian 12).
#pragma once

#if __has_include(<flint/arb.h>)
#include <flint/arb.h>
#else
#include <arb.h>
#endif
