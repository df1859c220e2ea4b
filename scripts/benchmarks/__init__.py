# SPDX-License-Identifier: Apache-2.0
"""Run time against error: what is measured (`rows`), the RTL (`clocks`), tables, curve and guard."""
