// SPDX-License-Identifier: MIT
// Exit code 0 if the installed library has the version of the installed header.
#include <zvo/zvo.h>

int main(void)
{
    return zvoVersion() == ZVO_VERSION ? 0 : 1;
}
