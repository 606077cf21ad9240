# SPDX-License-Identifier: GPL-3.0-or-later
"""What benchmark/run is made of: programs run as processes, peers, the thesis' figures, tables and plots."""
