# SPDX-License-Identifier: Apache-2.0
"""Waveforms for the eye: signals in groups (`signals`), real numbers (`formats`), viewers' files, a picture."""
