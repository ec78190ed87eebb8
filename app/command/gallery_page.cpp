#include "app/command/gallery_page.h"

#include <fmt/format.h>

#include "app/file/html.h"

namespace tumble {

namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>tumble</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { margin: 2rem auto; max-width: 1280px; padding: 0 1rem; background: #f8f8f6; color: #2b2f36;
       font: 16px/1.5 Lato, "DejaVu Sans", sans-serif; }
h1, h2 { font-weight: 700; } h2 { margin: 3rem 0 0; } p { margin: .3rem 0 1rem; color: #5c636e; }
figure { margin: 0 0 1rem; } figcaption { color: #5c636e; font-size: 14px; }
img, video { width: 100%; border: 1px solid #c9ced6; background: #fff; cursor: zoom-in; }
.plates { display: grid; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); gap: 1rem; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; }
td, th { padding: .1rem .8rem; text-align: right; border-bottom: 1px solid #e4e6ea; }
td:first-child, th:first-child { text-align: left; } .failed { color: #d5401a; font-weight: 700; }
dialog { width: 96vw; max-width: 96vw; border: 0; padding: 0; background: #f8f8f6; text-align: center; }
dialog img { max-height: 92vh; width: auto; max-width: 100%; border: 0; cursor: zoom-out; }
</style></head><body>
<h1>tumble</h1>
<p>Click a picture to enlarge it; the arrow keys leaf through all of them.</p>
)";

constexpr const char* kTail = R"(<dialog><img alt=""><p></p></dialog>
<script>
const plates = [...document.querySelectorAll('figure img')], dialog = document.querySelector('dialog');
let now = 0;
function show(index) {
  now = (index + plates.length) % plates.length;
  dialog.querySelector('img').src = plates[now].src;
  dialog.querySelector('p').textContent = plates[now].alt;
  if (!dialog.open) dialog.showModal();
}
plates.forEach((plate, index) => plate.onclick = () => show(index));
dialog.onclick = () => dialog.close();
document.onkeydown = event => {
  const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
  if (step) show(dialog.open ? now + step : now);
};
</script></body></html>
)";

std::string claimTable(const Verdict& verdict) {
  std::string out =
      fmt::format("<details{}><summary>{} claims, {} failed</summary><table>\n",
                  verdict.failed > 0 ? " open" : "", verdict.rows.size(), verdict.failed);
  out += "<tr><th>claim</th><th>measured</th><th>exact</th><th>error</th><th>allowed</th></tr>\n";
  for (const ClaimRow& row : verdict.rows)
    out += fmt::format(
        "<tr{}><td>{}</td><td>{:.10g}</td><td>{:.10g}</td><td>{:.2g}</td><td>{:.2g}</td></tr>\n",
        row.holds() ? "" : " class=\"failed\"", htmlText(row.label), row.measured, row.exact,
        row.error, row.allowed);
  return out + "</table></details>\n";
}

std::string section(const Exhibit& exhibit) {
  const Scene& scene = exhibit.scene;
  std::string out =
      fmt::format("<h2 id=\"{0}\">{1}</h2>\n<p>{0}: {2}</p>\n<div class=\"plates\">\n",
                  htmlText(scene.name), htmlText(scene.title), htmlText(scene.claim));
  for (const Plate& plate : exhibit.plates)
    out += fmt::format(
        "<figure><img loading=\"lazy\" src=\"{}\" "
        "alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
        htmlText(plate.file), htmlText(scene.title + ": " + plate.caption),
        htmlText(plate.caption));
  if (!exhibit.film.empty())
    out += fmt::format(
        "<figure><video controls src=\"{}\"></video><figcaption>film</figcaption>"
        "</figure>\n",
        htmlText(exhibit.film));
  return out + "</div>\n" + claimTable(exhibit.verdict);
}

}  // namespace

std::string galleryPage(const std::vector<Exhibit>& exhibits) {
  std::string out = kHead;
  for (const Exhibit& exhibit : exhibits) out += section(exhibit);
  return out + kTail;
}

}  // namespace tumble
