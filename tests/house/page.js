// Drives a page of `tumble render --html` and tells the console what came of it: "said: done SHARE MEAN
// DRAWS DRAG", or what is wrong.
const said = text => console.log('said: ' + text);
// A browser without a screen takes some of its window for bars that nobody sees.
Object.defineProperty(window, 'innerWidth', { get: () => 960 });
Object.defineProperty(window, 'innerHeight', { get: () => 540 });
const wrongs = [];
addEventListener('error', e => wrongs.push('error: ' + e.message));
addEventListener('unhandledrejection', e => wrongs.push('error: ' + e.reason));
const tellError = console.error;
console.error = (...words) => { wrongs.push('console: ' + words.join(' ')); tellError(...words); };
const rest = ms => new Promise(done => setTimeout(done, ms));

async function pixels(source, width, height) {
  const image = new Image();
  image.src = source;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext('2d');
  pen.drawImage(image, 0, 0, width, height);
  return pen.getImageData(0, 0, width, height).data;
}

addEventListener('load', async () => {
  for (let tries = 0; !window.tumble && !wrongs.length && tries < 400; ++tries) await rest(50);
  const need = (what, ok) => { if (!ok) wrongs.push('FAILED: ' + what); };
  try {
    const t = window.tumble, canvas = t.canvas;
    // The image of the instant.
    const rate = (t.count - 1) / t.seconds;
    t.seek(AT * rate);
    await rest(100);
    t.draw();
    const own = canvas.toDataURL();
    const a = await pixels(own, canvas.width, canvas.height), b = await pixels(EXPECTED, canvas.width, canvas.height);
    let off = 0, sum = 0;
    for (let i = 0; i < a.length; i += 4) {
      let worst = 0;
      for (let c = 0; c < 3; ++c) { const d = Math.abs(a[i + c] - b[i + c]); worst = Math.max(worst, d); sum += d; }
      off += worst > 16;
    }
    // Scrub, keys, play, drag.
    const slider = document.getElementById('time');
    slider.value = 3;
    slider.dispatchEvent(new Event('input'));
    await rest(100);
    need('the slider seeks', t.sample === 3);
    document.body.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }));
    await rest(100);
    need('an arrow key goes one on', t.sample === 4);
    document.body.dispatchEvent(new KeyboardEvent('keydown', { key: ' ', bubbles: true }));
    need('space plays', t.playing);
    for (let tries = 0; t.sample <= 5 && tries < 500; ++tries) await rest(10);
    need('play goes on', t.sample > 5);
    if (t.playing) document.getElementById('play').click();  // a slow machine may have come to the end
    const stopped = t.sample;
    await rest(200);
    need('pause stays', !t.playing && t.sample === stopped);
    const before = t.eye, point = (kind, x, y) => canvas.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true }));
    canvas.setPointerCapture = () => {};
    point('pointerdown', 400, 200);
    point('pointermove', 480, 220);
    point('pointerup', 480, 220);
    await rest(100);
    const way = Math.hypot(...t.eye.map((v, i) => v - before[i]));
    need('a drag turns the camera', way > 0.01);
    for (const id of ['glass', 'strobe', 'paths', 'forces']) { document.getElementById(id).click(); await rest(50); t.draw(); }
    said(wrongs.length ? wrongs.join('; ') : `done ${(400 * off / a.length).toFixed(3)} ${(sum / (0.75 * a.length)).toFixed(3)} ${t.draws} ${way.toFixed(2)}m`);
  } catch (error) {
    said([...wrongs, String(error)].join('; '));
  }
});
