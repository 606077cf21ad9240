// SPDX-License-Identifier: GPL-3.0-or-later
//
// A headless Chromium, whose WebGL runs on the processor.

import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

export async function launch() {
  const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
  if (!existsSync(executablePath))
    throw new Error(
      `${executablePath} is missing: install Chromium (Debian's package chromium), or set CHROMIUM to where it is`,
    );
  return chromium.launch({
    executablePath,
    args: [
      "--no-sandbox", // else it doesn't start for root
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--no-first-run",
    ],
  });
}
