import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {openOtherSite} from '../studio.mjs';

export const title = 'the page shows the building, is for nobody else, and outlives a crash';
// What was asked of a worker that ended.
export const expected = ['net::ERR'];

/** A worker ends, another follows: a correction that meets neither is written all the same, and the page says what happened. */
async function outlivesCrash({page, studio, check}) {
  await page.waitForSelector('html[data-ready]');
  const worker = Number(execFileSync('pgrep', ['-P', String(studio.pid)], {encoding: 'utf8'}).trim().split('\n')[0]);
  await page.route('**/api/correct', async route => {
    process.kill(worker, 'SIGKILL');
    await route.abort('connectionreset');
  }, {times: 1});
  const answer = await page.evaluate(() => window.oriel.source.correct({building: 0, feature: 3, class: 'door'}));
  check(answer.count === 1 && /"door"/.test(readFileSync(studio.path('corrections.jsonl'), 'utf8')), 'a correction is asked again when a worker has ended');
  await page.waitForFunction(() => /started again/.test(document.querySelector('.status').textContent));
  check(true, 'and the page says so');
}

/** Without WebGL the page says so, and has its lists. */
async function worksWithoutPicture({context, studio, check, picture}) {
  const page = await context.newPage();
  await page.addInitScript(() => {
    const {getContext} = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function(kind, ...rest) { return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest); };
  });
  await page.goto(studio.address);
  await page.waitForSelector('html[data-ready]');
  check(/draws no 3D/.test(await page.textContent('.no-picture')), 'without WebGL the page says so');
  check(await page.isVisible('.list-button'), 'and shows the list of buildings');
  await page.close();
}

export async function run({page, context, studio, check, picture}) {
  const answer = await page.goto(studio.address);
  check(answer.status() === 200, 'the address that is printed leads to the page');
  await page.locator('canvas').first().waitFor();
  await page.getByRole('tab', {name: 'Buildings'}).click();
  await page.getByText('house', {exact: true}).first().waitFor();
  check(true, 'the building has its name');
  await picture('page');

  const stranger = await page.request.get(`${studio.origin}/`, {failOnStatusCode: false});
  check(stranger.status() === 403, 'without the token there is no page');

  // A page of another site that even knows the token.
  const site = await openOtherSite('<!doctype html><title>another site</title>');
  const other = await context.newPage();
  await other.goto(site.address);
  const said = await other.evaluate(([address, token]) => {
    const form = new Blob(['{}'], {type: 'text/plain'});
    return Promise.all([
      fetch(address, {method: 'POST', mode: 'no-cors', body: form}).then(reply => reply.type, () => 'failed'),
      fetch(address, {method: 'POST', headers: {'X-Oriel-Token': token, 'Content-Type': 'application/json'}, body: '{}'})
        .then(reply => reply.status, () => 'failed')
    ]);
  }, [`${studio.origin}/api/state`, studio.token]);
  site.close();
  check(said[1] === 'failed', 'another site cannot ask');
  check(/refused: method=POST path=\/api\/state status=403/.test(studio.log), 'what it sent is refused and a line of the log');
  check(/refused: method=OPTIONS path=\/api\/state status=403/.test(studio.log), 'its browser was not allowed to ask');
  await worksWithoutPicture({context, studio, check, picture});
  await outlivesCrash({page, studio, check});
}
