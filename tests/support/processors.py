"""Processors that this machine can stand in for."""

PLAIN = ["qemu-x86_64", "-cpu", "Nehalem"]  # without AVX and FMA
OLD_LIBM = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F,-AVX"}  # the C library's functions for such a one
