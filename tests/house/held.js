// Opens a page of `tumble render --html` in frames of many shapes and tells the console whether every corner of every
// body that moves stands clear of title, controls and edges at every sample: "said: done", and the least share of the
// free room that the run fills along the dimension that binds; or what is wrong.
const said = text => console.log('said: ' + text);
const rest = ms => new Promise(done => setTimeout(done, ms));

async function fill(width, height) {
  const frame = document.createElement('iframe');
  frame.width = width;
  frame.height = height;
  frame.srcdoc = new TextDecoder().decode(Uint8Array.from(atob(PAGE), c => c.charCodeAt(0)));
  document.body.append(frame);
  for (let tries = 0; !frame.contentWindow.tumble && tries < 400; ++tries) await rest(50);
  const t = frame.contentWindow.tumble, at = `${width}x${height}`;
  const edge = (what, side) => frame.contentDocument.querySelector(what).getBoundingClientRect()[side];
  const top = edge('header', 'bottom'), bottom = edge('footer', 'top');
  let left = Infinity, right = -Infinity, high = Infinity, low = -Infinity;
  const see = (point, name, k) => {
    const place = t.project(point);
    if (!place) throw new Error(`${at}: ${name} stands behind the camera at sample ${k}`);
    left = Math.min(left, place[0]);
    right = Math.max(right, place[0]);
    high = Math.min(high, place[1]);
    low = Math.max(low, place[1]);
  };
  for (let k = 0; k < t.count; ++k) {
    t.points(k).forEach(point => see(point, 'what bends', k));
    t.bodies.forEach((body, i) => {
      if (!body.moves || body.shape < 0 || body.shape > 3) return;
      const pose = t.pose(i, k), centre = pose.slice(0, 3);
      for (let corner = 0; corner < 8; ++corner) {
        const arm = t.turned(pose, body.half.map((h, axis) => (corner >> axis & 1 ? h : -h)));
        see(arm.map((v, axis) => v + centre[axis]), body.name, k);
      }
    });
  }
  frame.remove();
  const px = v => v.toFixed(0);
  if (left < 0 || right > width || high < top || low > bottom)
    throw new Error(`${at}: bodies from ${px(left)} to ${px(right)} and ${px(high)} to ${px(low)} px; free are 0 to ${width} and ${px(top)} to ${px(bottom)}`);
  return Math.max((right - left) / width, (low - high) / (bottom - top));
}

addEventListener('load', async () => {
  try {
    let least = 1;
    for (const [width, height] of [[1280, 900], [1280, 720], [360, 640], [800, 300], [600, 600]]) least = Math.min(least, await fill(width, height));
    said(least > 0.5 ? `done ${(100 * least).toFixed(0)} % of the room, at least` : `the run fills no more than ${(100 * least).toFixed(0)} % of a window`);
  } catch (error) {
    said(String(error));
  }
});
